"""The best path: the true offset of a whole contour, trimmed globally, in one or several loops."""
