"""The judge: what a centre path does to a surface, found without any code of comp."""
