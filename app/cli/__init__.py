"""The command line: its arguments, and a module for each group of commands."""
