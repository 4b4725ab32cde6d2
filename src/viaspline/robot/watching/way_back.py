"""Whether a robot that was set beside its path, by hand or by its filter, may drive back to it."""

from __future__ import annotations

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.world.world import World

SETTLED = 4.0
"""After so many distances of convergence a deviation has died out."""

PLACES = 65
"""At which the room is looked at on the way back."""

NEARER_M = 0.01
"""By which it may get nearer to something than it is [m]."""


def way_back(path: Path, start: float, at: Floats, over: float) -> Floats:
    """Where a robot drives that comes back to its path, as its control law does.

    Args:
        path: It comes back to this one.
        start: Its place along it [m].
        at: Where it is [m], shape (d,).
        over: The distance over which a deviation dies out [m].

    Returns:
        Places, its own first [m], shape (n, d).

    Example:
        >>> path = Path([[[0, 0], [3, 0], [6, 0], [9, 0]]], vias=[])
        >>> back = way_back(path, 1.0, np.array([1.0, 0.5]), over=1.0)
        >>> back[0].round(3).tolist(), bool(abs(back[-1, 1]) < 0.05)
        ([1.0, 0.5], True)
    """
    gone = np.linspace(0.0, SETTLED, PLACES)
    along = np.minimum(start + gone * over, path.length)
    aside = at - np.asarray(path.at_distance(start))
    left = (1.0 + gone) * np.exp(-gone)
    return np.asarray(path.at_distance(along)) + left[:, None] * aside


def is_way_back_clear(world: World, places: Floats, required: float) -> bool:
    """Whether a way back keeps a distance, or comes no nearer than the robot is by now.

    Args:
        world: All that is known.
        places: The way, from the robot on [m], shape (n, d).
        required: The distance to keep from the robot's middle [m].
    """
    if not len(world):
        return True
    room: Floats = world.distance(places)
    return bool(room.min() >= min(required, float(room[0])) - NEARER_M)
