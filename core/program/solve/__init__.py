"""What follows from what was typed: each segment solved from its own fields and its start."""
