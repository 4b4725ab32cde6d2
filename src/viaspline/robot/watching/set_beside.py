"""Whether a robot that was set beside its path, by hand or by its filter, may drive back to it."""

from __future__ import annotations

import math

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.kernels.tracking.control_law import MAX_APPROACH_RAD
from viaspline.world.world import World

SETTLED = 4.0
"""After so many distances of convergence a deviation has died out."""

PLACES = 65
"""At which the room is looked at on the way back."""

SUBSTEPS = 4
"""From place to place, by which that way is reckoned."""

STEEPEST_RAD = 1.2
"""A robot that looks away by more is taken to look away by this [rad]."""

NEARER_M = 0.01
"""By which it may get nearer to something than it is [m]."""


def way_back(
    path: Path, start: float, at: Floats, over: float, beside: float = 0.0, looks: float = 0.0
) -> Floats:
    """Where a robot drives that comes back to its path, as its control law does.

    Args:
        path: It comes back to this one.
        start: Its place along it [m].
        at: Where it is [m], shape (d,).
        over: The distance over which a deviation dies out [m].
        beside: So far it stays beside the path first, while it brakes [m].
        looks: By how much it looks to the left of where the path leads [rad].

    Returns:
        Places, its own first [m], shape (n, d).

    Example:
        >>> path = Path([[[0, 0], [3, 0], [6, 0], [9, 0]]], vias=[])
        >>> back = way_back(path, 1.0, np.array([1.0, 0.5]), over=1.0)
        >>> back[0].round(3).tolist(), bool(abs(back[-1, 1]) < 0.05)
        ([1.0, 0.5], True)
    """
    aside = at - np.asarray(path.at_distance(start))
    off = float(np.linalg.norm(aside))
    driven = np.linspace(0.0, beside + SETTLED * dies_out_over(off, over), PLACES)
    along = np.minimum(start + driven, path.length)
    left_of = 1.0
    if path.dimension == 2:  # it stays on its side where the path bends
        turned = np.asarray(path.heading(path.parameter(along)))
        left_of = float(math.cos(turned[0]) * aside[1] - math.sin(turned[0]) * aside[0])
        turned = turned - turned[0]
        c, s = np.cos(turned), np.sin(turned)
        aside = np.column_stack((c * aside[0] - s * aside[1], s * aside[0] + c * aside[1]))
    towards = math.copysign(1.0, left_of) * looks
    gone = np.maximum(driven - beside, 0.0)
    left = _left(off, towards, gone, over) / off if off > 0.0 else np.ones(PLACES)
    return np.asarray(path.at_distance(along)) + left[:, None] * aside


def dies_out_over(off: float, over: float) -> float:
    """The distance over which a deviation [m] dies out, if a small one does over ``over`` [m].

    From far away a robot comes back at a steady angle.

    >>> dies_out_over(0.5, 1.0), dies_out_over(8.0, 1.0)
    (1.0, 4.0)
    """
    return max(over, 0.5 * off / MAX_APPROACH_RAD)


def _left(off: float, looks: float, gone: Floats, over: float) -> Floats:
    """What is left of a deviation by the control law (see ``turn_law``) [m], shape (n,).

    Args:
        off: What it is at first [m].
        looks: By how much the robot looks away from its path [rad].
        gone: Distances along the path from there, in order [m], shape (n,).
        over: The distance over which a small one dies out [m].
    """
    left, angle, found = off, min(max(looks, -STEEPEST_RAD), STEEPEST_RAD), [off]
    for ahead in np.diff(gone).tolist():
        for _ in range(SUBSTEPS if ahead > 0.0 else 0):
            part = ahead / SUBSTEPS
            wanted = -min(max(0.5 * left / over, -MAX_APPROACH_RAD), MAX_APPROACH_RAD)
            share = 1.0 - math.exp(-2.0 * part / (over * math.cos(angle)))
            angle += share * (wanted - angle)
            left += part * math.tan(angle)
        found.append(left)
    return np.array(found)


def room_on(world: World, places: Floats) -> Floats:
    """The room about the robot's middle at some places [m], shape (n,)."""
    if not len(world):
        return np.full(len(places), np.inf)
    room: Floats = world.distance(places)
    return room


def floor_back(room: Floats, required: float, body: float, braking: float = 0.0) -> float:
    """The distance that a robot keeps on its way back, if it gets no nearer than it can help [m].

    Args:
        room: About the robot's middle along the way, from where it is on [m], shape (n,).
        required: The distance to keep from there [m].
        body: What would be a touch [m].
        braking: The part of the way that it needs to stand; if it stops it gets as near.
    """
    unavoidable = room[: 1 + int(braking * (len(room) - 1))]
    return max(min(required, float(unavoidable.min())), body)


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
    floor = floor_back(room, required, body, braking)
    return bool(room.min() >= floor - NEARER_M) and float(room.min()) > body
