"""Fleets in space: paths past resting places, crossings and proofs in three dimensions."""
