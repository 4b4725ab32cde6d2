"""What is asked of a path, and what it is made of."""
