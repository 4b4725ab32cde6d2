"""What moves and isn't on the map: seen, followed over time, foretold."""
