"""Paths for robots with a turning circle."""
