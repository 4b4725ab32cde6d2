"""Many robots: where their paths come near each other, and laws that keep them apart."""
