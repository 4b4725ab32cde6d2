"""Paths for robots with a turning circle: straight lines, and turns with ramps."""
