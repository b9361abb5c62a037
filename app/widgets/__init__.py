"""Widgets: the parts that screens are composed of."""
