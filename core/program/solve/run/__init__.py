"""Runs: LINEs and ARCs whose ends their own fields do not give, calculated together from what precedes and follows."""
