"""Turns through via points: a rounded corner whose middle is the via point itself.

The leg before it ends with the first half of the corner and the leg after it begins with the second
one, each towards what is next on its own leg. Both bend by the same radius there, to the same side:
so the curve has no jump of curvature, whatever the legs do then. The formulas are those of
``space/laying/corner_rounding``. Tested through ``space/laying/test_via_turns``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.space.corner_polygon import (
    C2,
    C3,
    CUT,
    SETTLING,
    SHARPEST_TURN,
    reach_of_one,
)

FORK = 1.2
"""Of the radius that is wanted, times the cosine of half the turn: where a way nearly goes back a
wide turn is a long one, and slowing down takes less time."""

STRAIGHT = 1e-6
"""What turns by less than that [rad] is passed straight."""

MOST_SETTLING = 60
SETTLED = 1e-13
"""How often half a turn is pointed anew to where it ends, and by how little in the end [rad]."""


@inner
def _unit_to(here: Floats, there: Floats, way: Floats) -> float:
    """Writes the direction from one place to another; how far that is [m]."""
    total = 0.0
    for axis in range(len(here)):
        way[axis] = there[axis] - here[axis]
        total += way[axis] * way[axis]
    size = math.sqrt(total)
    for axis in range(len(here)):
        way[axis] = way[axis] / size if size > 0.0 else 0.0
    return size


@inner
def _settled(
    via: Floats, way: Floats, inside: Floats, towards: Floats, radius: float
) -> tuple[float, float]:
    """The angle [rad] and the reach [m] of half a turn towards a place.

    The corner lies outside of the via point by what the rounding cuts off.
    """
    angle = reach = 0.0
    for _ in range(MOST_SETTLING):
        before = angle
        beyond = CUT * math.sin(angle) * reach
        along = across = 0.0
        for axis in range(len(via)):
            apart = towards[axis] - via[axis] + beyond * inside[axis]
            along += apart * way[axis]
            across += apart * inside[axis]
        angle = min(max(math.atan2(across, along), 0.0), 0.5 * SHARPEST_TURN)
        reach = radius * reach_of_one(2.0 * angle)
        if abs(angle - before) < SETTLED:
            break
    return angle, reach


@inner
def _widest(via: Floats, way: Floats, inside: Floats, towards: Floats, share: float) -> float:
    """The radius [m] at which half a turn reaches that share of the way to a place."""
    along = across = square = 0.0
    for axis in range(len(via)):
        apart = towards[axis] - via[axis]
        along += apart * way[axis]
        across += apart * inside[axis]
        square += apart * apart
    most = share * math.sqrt(square)
    angle = 0.0
    for _ in range(SETTLING):
        angle = math.atan2(across + CUT * math.sin(angle) * most, along)
        angle = min(max(angle, STRAIGHT), 0.5 * SHARPEST_TURN)
    return most / reach_of_one(2.0 * angle)


@kernel
def turn_through(
    via: Floats, before: Floats, after: Floats, share_before: float, share_after: float
) -> Floats:
    """How a way turns at a via point.

    Args:
        via: [m], (d,).
        before: What comes before it [m], (d,).
        after: What comes after it [m], (d,).
        share_before: Of the way from there that the turn may take.
        share_after: Of the way to there.

    Returns:
        The direction there, the one square to it to which the way bends, the greatest radius for
        which there is room [m], and the share of a radius that is wanted with which the turn is
        soonest, (2 d + 2,); NaN where the way goes straight on or right back.
    """
    axes = len(via)
    turn = np.full(2 * axes + 2, np.nan)
    back, on = np.empty(axes), np.empty(axes)
    if _unit_to(via, before, back) == 0.0 or _unit_to(via, after, on) == 0.0:
        return turn
    ahead = aside = 0.0
    for axis in range(axes):
        ahead += (on[axis] - back[axis]) ** 2
        aside += (on[axis] + back[axis]) ** 2
    ahead, aside = math.sqrt(ahead), math.sqrt(aside)
    angle = 2.0 * math.atan2(aside, ahead)
    if angle < STRAIGHT or angle > SHARPEST_TURN:
        return turn
    for axis in range(axes):
        turn[axis] = (on[axis] - back[axis]) / ahead
        turn[axes + axis] = (on[axis] + back[axis]) / aside
    way, inside = turn[:axes].copy(), turn[axes : 2 * axes].copy()
    turn[2 * axes] = min(
        _widest(via, way, inside, after, share_after),
        _widest(via, -way, inside, before, share_before),
    )
    turn[2 * axes + 1] = min(1.0, FORK * math.cos(0.5 * angle))
    return turn


@kernel
def turn_radius(turn: Floats, wanted: float) -> float:
    """The radius of a turn where a leg wants one [m].

    Args:
        turn: See ``space/laying/via_turns``, (2 d + 3,).
        wanted: By the leg [m].
    """
    at = len(turn) - 3
    most, share, close = turn[at], turn[at + 1], turn[at + 2]
    return min(most, max(min(close, wanted), share * wanted))


@kernel
def half_turn(via: Floats, way: Floats, inside: Floats, towards: Floats, radius: float) -> Floats:
    """The half of a turn that leaves a via point.

    Args:
        via: [m], (d,).
        way: Direction in which it is left, a unit vector, (d,).
        inside: The one square to it to which the curve bends, likewise.
        towards: The place to which the curve points then, nearly, if that lies elsewhere than in
            the plane of the turn [m], (d,).
        radius: Of curvature at the via point [m].

    Returns:
        A Bézier control polygon [m], (4, d), that ends straight.
    """
    angle, reach = _settled(via, way, inside, towards, radius)
    beyond = CUT * math.sin(angle) * reach
    span = np.empty((4, len(via)))
    for axis in range(len(via)):
        corner = via[axis] - beyond * inside[axis]
        on = math.cos(angle) * way[axis] + math.sin(angle) * inside[axis]
        span[0, axis] = via[axis]
        span[1, axis] = corner + on * CUT * reach
        span[2, axis] = corner + on * (1.0 - C2 * C3) * reach
        span[3, axis] = corner + on * reach
    return span
