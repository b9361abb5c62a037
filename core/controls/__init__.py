"""NC programs as each control reads and compensates them."""
