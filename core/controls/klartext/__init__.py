"""This package runs HEIDENHAIN conversational programs: it reads, rounds and chamfers, and compensates (RL, RR)."""
