"""Cubics: evaluation, arc length, tangents and curvature, extrema, proven bounds."""
