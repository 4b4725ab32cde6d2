"""What a mission asks for in space: its keys, where they put things, and what may be wrong."""
