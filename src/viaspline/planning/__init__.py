"""From via points to a proven path: routes, the spline along them, what a robot can drive of it."""
