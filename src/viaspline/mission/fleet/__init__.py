"""Fleets: many robots in one world."""
