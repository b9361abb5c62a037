"""This package solves runs: LINEs and ARCs that their own fields do not determine, calculated together."""
