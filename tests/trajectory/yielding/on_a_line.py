"""A robot on a straight line, and what comes across it or stands on it."""

import numpy as np

from viaspline.curve.path import Path
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.trajectory.limits import Limits

LIMITS = Limits(max_speed=2, max_accel=1)


def line(length: float = 30.0) -> Path:
    """A straight path from (0, 0) along x."""
    return Path([np.linspace(0.0, 1.0, 4)[:, None] * (length, 0.0)], vias=[])


def cart(x: float, start: float, speed: float, radius: float = 1.0) -> Obstacle:
    """A disc that goes up across the line at x."""
    motion = {"from": (x, start), "velocity_mps": (0, speed)}
    return Obstacle(name="cart", circle={"center": (0, 0), "radius": radius}, motion=motion)


def parked(at: float, frames: list[list[float]], after: str) -> Obstacle:
    """A disc of 0.5 m on the line at some keyframes, seen from a place."""
    moved = [[t, at + x, y] for t, x, y in frames]
    motion = {"keyframes": moved, "after": after}
    return Obstacle(name="cart", circle={"center": (0, 0), "radius": 0.5}, motion=motion)
