"""Links to other machines: each protocol a room of its own, imported by nothing else."""
