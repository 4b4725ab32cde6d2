"""Pictures and films of fleets: where they drive, who waits for whom, how far apart they stay."""
