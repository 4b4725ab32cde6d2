"""Taut routes in space: searched on a lattice, pulled taut, or shown to be impossible."""
