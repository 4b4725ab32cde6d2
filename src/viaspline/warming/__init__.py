"""What compiles and loads all that a mission, or viaspline, can need."""
