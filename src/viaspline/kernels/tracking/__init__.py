"""A machine that follows a path: its reference, its control law, its motion."""
