"""Drawings for the terminal: a scene of paths as rows of character cells."""
