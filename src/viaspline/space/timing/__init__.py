"""The time law in space: how fast it may climb, descend and turn."""
