"""Giving way to what moves: in time on the path, on another side, or by a stop."""
