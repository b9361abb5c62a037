"""Cutter compensation: the centre path under the control's look-ahead rule."""
