"""What the user asks for: types that declare each key once, every fault of a mission at once."""
