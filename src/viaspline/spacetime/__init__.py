"""Paths and time laws chosen together: past what moves, on either side, before or after it."""
