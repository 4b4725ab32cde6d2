"""Piecewise cubics and cardinal splines in any dimension, and the proof of their clearance."""
