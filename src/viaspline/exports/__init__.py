"""The proven path in other people's formats: as points with a stated error, proven once more."""
