"""The judge: what a center path does to a surface, calculated without any code of comp."""
