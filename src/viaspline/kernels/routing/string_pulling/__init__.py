"""A guide pulled taut on the true shapes of obstacles."""
