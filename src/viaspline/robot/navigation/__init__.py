"""Where a robot is on its way, what it knows, what it means to do and what has happened."""
