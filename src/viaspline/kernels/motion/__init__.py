"""Obstacles that move: where they are when, and how far from them a place is."""
