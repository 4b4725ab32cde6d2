"""Missions in space: routes, curves through them, what is proven of them, and their time law."""
