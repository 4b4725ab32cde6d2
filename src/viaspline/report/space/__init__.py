"""Pictures of missions in space: seen from above, unrolled along the path, and from the side."""
