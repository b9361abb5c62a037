"""Exact lines and arcs: paths, intersections, distances, constructions."""
