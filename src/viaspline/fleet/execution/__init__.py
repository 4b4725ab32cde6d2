"""Driving the plan of a fleet: orders, grants, delays."""
