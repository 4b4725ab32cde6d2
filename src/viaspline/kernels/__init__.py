"""Compiled array functions: arrays in, arrays out; no objects, no units, no files."""
