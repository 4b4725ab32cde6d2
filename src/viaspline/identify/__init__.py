"""A robot's drive from a log of one: how late, how slow, how noisy it is."""
