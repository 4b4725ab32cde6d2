"""From taut ways and via points to one smooth curve."""
