"""Cutter compensation: the center path under the control's look-ahead rule."""
