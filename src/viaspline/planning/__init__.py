"""Ways past what stands in the way: either side, the spline through it, the ledger, re-planning."""
