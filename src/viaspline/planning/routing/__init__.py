"""Taut paths between two places, the order of places, and why there is no path."""
