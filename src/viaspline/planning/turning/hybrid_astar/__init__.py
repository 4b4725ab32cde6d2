"""The search among poses: for tight space, the last of the methods."""
