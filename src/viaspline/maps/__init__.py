"""Other people's maps: occupancy grids and polygons, read into plain values."""
