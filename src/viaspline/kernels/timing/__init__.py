"""The time law along a path: bounds on cells, reachability, the fastest profile."""
