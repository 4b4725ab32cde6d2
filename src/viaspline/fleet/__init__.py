"""Many robots in one world: paths, conflicts, timing, proof, grants."""
