"""What the simulator is made of: sensors, exact and driven motion, contacts, and the run."""
