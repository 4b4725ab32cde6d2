"""Missions in space among things that move: laws past them, and the proof of that."""
