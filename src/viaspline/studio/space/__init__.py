"""Missions in space in the studio: planned, shown from above, from the side and in 3-D, flown."""
