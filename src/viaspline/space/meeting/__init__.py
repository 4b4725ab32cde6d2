"""Bodies that move in space: where and when two of them come near each other."""
