"""The world in space: packed solids, ground and limits of height."""
