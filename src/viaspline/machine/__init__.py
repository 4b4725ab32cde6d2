"""Machines: how drives move, how they are made to follow a path, and how near they stay to it."""
