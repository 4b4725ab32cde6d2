"""detour."""
