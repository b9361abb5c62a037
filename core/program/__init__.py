"""What the operator typed, what follows from it, and how it is edited and stored."""
