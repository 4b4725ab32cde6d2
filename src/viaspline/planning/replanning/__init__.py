"""Paths laid anew under way: how the old one is left, and where it is taken up again."""
