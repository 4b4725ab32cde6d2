"""Plans of fleets that were saved: what is kept of them, and how it is read and proven again."""
