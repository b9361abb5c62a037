"""The widgets: the parts that screens are composed of."""
