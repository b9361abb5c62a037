"""The screens painted row by row."""
