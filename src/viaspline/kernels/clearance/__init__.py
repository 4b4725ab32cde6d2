"""Certificates: proven bounds of the distance between a moving body and a world."""
