"""What a robot senses, and what it knows of the world by it."""
