"""Compensation as controls do it: corners, joints of offset elements, entries and exits, look-ahead."""
