"""Paths as rows of character cells."""
