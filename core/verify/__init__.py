"""The judge: what a center path does to a surface, found without any code of comp."""
