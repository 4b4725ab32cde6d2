"""Taut routes in space: found, refused with a proof, or given up; seeds on each side."""
