"""Lines and turns with clothoid ramps, for robots with a turning circle."""
