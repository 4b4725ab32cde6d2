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


def way_back(path: Path, start: float, at: Floats, over: float, beside: float = 0.0) -> Floats:
    """Where a robot drives that comes back to its path, as its control law does.

    Args:
        path: It comes back to this one.
        start: Its place along it [m].
        at: Where it is [m], shape (d,).
        over: The distance over which a deviation dies out [m].
        beside: So far it stays beside the path first, while it brakes [m].

    Returns:
        Places, its own first [m], shape (n, d).

    Example:
        >>> path = Path([[[0, 0], [3, 0], [6, 0], [9, 0]]], vias=[])
        >>> back = way_back(path, 1.0, np.array([1.0, 0.5]), over=1.0)
        >>> back[0].round(3).tolist(), bool(abs(back[-1, 1]) < 0.05)
        ([1.0, 0.5], True)
    """
    driven = np.linspace(0.0, beside + SETTLED * over, PLACES)
    gone = np.maximum(driven - beside, 0.0) / over
    along = np.minimum(start + driven, path.length)
    aside = at - np.asarray(path.at_distance(start))
    if path.dimension == 2:  # it stays on its side where the path bends
        turned = np.asarray(path.heading(path.parameter(along)))
        turned = turned - turned[0]
        c, s = np.cos(turned), np.sin(turned)
        aside = np.column_stack((c * aside[0] - s * aside[1], s * aside[0] + c * aside[1]))
    left = (1.0 + gone) * np.exp(-gone)
    return np.asarray(path.at_distance(along)) + left[:, None] * aside


def room_on(world: World, places: Floats) -> Floats:
    """The room about the robot's middle at some places [m], shape (n,)."""
    if not len(world):
        return np.full(len(places), np.inf)
    room: Floats = world.distance(places)
    return room


def is_way_back_clear(room: Floats, required: float, body: float, braking: float = 0.0) -> bool:
    """Whether a way back keeps a distance, or comes no nearer than the robot can help.

    Args:
        room: About the robot's middle along the way, from where it is on [m], shape (n,).
        required: The distance to keep from there [m].
        body: What would be a touch [m].
        braking: The part of the way that it needs to stand; if it stops it gets as near.

    Example:
        >>> room = np.array([1.0, 0.7, 0.8, 0.9])
        >>> is_way_back_clear(room, 0.8, 0.3), is_way_back_clear(room, 0.8, 0.3, braking=0.5)
        (False, True)
    """
    unavoidable = room[: 1 + int(braking * (len(room) - 1))]
    floor = max(min(required, float(unavoidable.min())), body)
    return bool(room.min() >= floor - NEARER_M) and float(room.min()) > body
