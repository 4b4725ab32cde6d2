"""What is written: results as a whole, JSON and tables."""
