"""What is said in the terminal: lines, tables, progress, and what becomes of it when it ends."""
