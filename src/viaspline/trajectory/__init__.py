"""The time law along a path."""
