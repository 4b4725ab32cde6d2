"""What the user asks for: types, YAML reader and writer, every fault of a mission at once."""
