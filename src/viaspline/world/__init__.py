"""What the robot keeps clear of: obstacles, bounds and fences, and the distance to them."""
