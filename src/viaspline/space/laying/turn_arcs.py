"""Arcs from the direction of a via point towards what is next, as corners of a leg.

Tested through ``space/laying/test_gentle_turns``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.space.laying.laid_route import RouteLegs
from viaspline.space.laying.turn_ways import LEAST_WAY, beside

ARC_STEP: Final = math.radians(60.0)
"""By so much an arc turns at each of its corners, at most."""

ABOUT: Final = math.radians(60.0)
"""What lies farther round from a direction than that is gone to by an arc."""


def asides(legs: RouteLegs, leg: int, via: int, way: Floats) -> Iterator[Floats]:
    """The directions square to a given one in which an arc towards what is next may turn.

    Towards it, and to both sides where it lies behind.
    """
    to = beside(legs, via, 1 if via == leg else -1)
    if via != leg:
        way = -way
    to = to / np.linalg.norm(to)
    if float(to @ way) > math.cos(ABOUT):
        return
    towards = to - (to @ way) * way
    size = float(np.linalg.norm(towards))
    if size > LEAST_WAY:
        yield towards / size
    level = np.array([-way[1], way[0], 0.0])
    size = float(np.linalg.norm(level))
    if size > LEAST_WAY:
        yield level / size
        yield -level / size


def arc(legs: RouteLegs, leg: int, via: int, way: Floats, aside: Floats, radius: float) -> Floats:
    """The corners of an arc from a via point's direction to what is next [m], from there on.

    Args:
        legs: Of the route.
        leg: The leg.
        via: The via point where the arc begins or ends.
        way: The direction there.
        aside: Where the arc turns, square to it.
        radius: Of the arc [m].
    """
    leaves = via == leg
    place, way = legs.vias[via], way if leaves else -way
    centre = place + radius * aside
    to = place + beside(legs, via, 1 if leaves else -1) - centre
    # From the centre the via point lies against `aside`, and flight begins along `way`.
    along, across = float(to @ way), float(to @ -aside)
    distance = math.hypot(along, across)
    angle = math.atan2(along, across) % math.tau
    angle -= math.acos(min(1.0, radius / distance)) if distance > 0.0 else 0.0
    angle = angle % math.tau
    steps = max(1, math.ceil(angle / ARC_STEP))
    at = (np.arange(steps) + 0.5) * angle / steps
    return np.asarray(centre + radius * (np.sin(at)[:, None] * way - np.cos(at)[:, None] * aside))
