"""Why a robot of a fleet isn't served, what is proven of that, and what would help."""
