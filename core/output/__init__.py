"""What leaves the program: NC text, drawings, sheets."""
