"""Beams of a lidar, and what they say is free."""
