"""The kinds of obstacles: one file each, and what all of them are to the rooms above."""
