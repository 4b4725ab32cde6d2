"""A picture under the map, and where on earth that lies: kept beside the mission."""
