"""Terminal: everything that is about bytes, keys and characters."""
