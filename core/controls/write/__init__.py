"""A contour written as a compensated program for a control, and read back through that control's rules."""
