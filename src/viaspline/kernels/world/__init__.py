"""A packed world: what it is made of, how far away it is, what it covers, what stands together."""
