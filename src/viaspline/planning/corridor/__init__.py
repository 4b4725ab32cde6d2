"""The line of least curvature inside a corridor."""
