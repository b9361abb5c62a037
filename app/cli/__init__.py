"""The command line: arguments, and a module for each group of commands."""
