"""A contour written as a control's own compensated program, and read back through its rules."""
