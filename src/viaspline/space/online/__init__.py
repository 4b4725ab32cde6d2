"""Under way in space: what a sensor sees, and another path before the robot comes there."""
