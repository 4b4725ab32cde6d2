"""The methods of laying a path, a file each, and the order in which they are asked."""
