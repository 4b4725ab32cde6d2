"""Closed patrols of a fleet, which never end: a common period, and a proof for ever."""
