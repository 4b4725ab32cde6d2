"""The time law among things that move: what is blocked when, and the way through."""
