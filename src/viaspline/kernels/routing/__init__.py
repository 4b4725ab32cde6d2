"""Shortest paths past obstacles: exact among few, on a mesh and pulled taut among many."""
