"""This package calculates the blanks of a block: each segment from its own fields and its start, or in a run."""
