"""Sensor, navigator and simulator: a path is driven, and laid anew where something new is seen."""
