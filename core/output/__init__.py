"""Writes what leaves the program: NC text, drawings, sheets."""
