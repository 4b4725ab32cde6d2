"""Dense fleets: an order of passing from a search on a lattice, and paths laid along it."""
