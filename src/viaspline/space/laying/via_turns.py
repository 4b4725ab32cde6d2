"""How a route turns at via points between two legs that are led round something.

A via point is passed in the middle of a rounded corner there, as a detour via point is. Were it
passed straight on, in a direction between both legs, the curve would turn before it and once more
after it: where a way nearly goes back, that is a loop.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.space.half_turns import turn_radius, turn_through
from viaspline.space.laying.via_directions import Inner

ROOMY: Final = 1.25
"""Than the least radius the wanted one is so much wider: corners that are moved get sharper."""

SHARED, ALONE = 0.45, 0.9
"""Of the way to what is next that half a turn may take: to another corner, and to where the route
begins or ends."""

FORWARD, BACK = math.radians(45.0), math.radians(72.0)
"""What lies so far round from the direction at a via point is gone to by a turn that is as wide as
is wanted, or as close as it may be: a wide one would be a loop."""


def no_turns(count: int, axes: int) -> Floats:
    """Those of so many via points that have none."""
    return np.full((count, 2 * axes + 3), np.nan)


def via_turns(
    vias: Floats, inner: Sequence[Inner], given: Floats, radii: Sequence[Floats], close: float
) -> Floats:
    """The turns at the via points of a route.

    Args:
        vias: The via points [m], shape (n, d).
        inner: The detour via points of each leg, n - 1; None where it is the spline.
        given: Directions that are fixed, shape (n, d), NaN where none is.
        radii: How gently legs turn at their via points and detours [m], one array for each leg.
        close: How close turns may be, however soon that is [m].

    Returns:
        For each via point the direction there, the one square to it to which the curve bends, its
        greatest radius [m], what it has of the radius that is wanted by a leg, and ``close``,
        (n, 2 d + 3); NaN where the legs have a direction alone: there is no room for that.

    >>> square = np.array([[0.0, 0], [100, 0], [100, 100]])
    >>> free, none, wide = np.full((3, 2), np.nan), np.empty((0, 2)), np.full(2, 5.0)
    >>> via_turns(square, [none, none], free, [wide, wide], 1.0)[1].round(3)
    array([ 0.707,  0.707, -0.707,  0.707,  4.243,  0.849,  1.   ])
    """
    turns = no_turns(*vias.shape)
    for k in range(1, len(vias) - 1):
        before, after = inner[k - 1], inner[k]
        if before is None or after is None or not np.isnan(given[k, 0]):
            continue
        back = before[-1] if len(before) else vias[k - 1]
        on = after[0] if len(after) else vias[k + 1]
        to_end = ALONE if k == 1 and not len(before) else SHARED
        from_end = ALONE if k == len(vias) - 2 and not len(after) else SHARED
        turn = turn_through(vias[k], back, on, to_end, from_end)
        if ROOMY * turn[-2] >= close:
            turns[k, :-1], turns[k, -1] = turn, close
            wanted = min(float(radii[k - 1][-1]), float(radii[k][0]))
            turns[k, -3] = turn_radius(turns[k], wanted)
    return turns


def aside_radius(way: Floats, apart: Floats, wanted: float, close: float) -> float:
    """The radius with which it is soonest to turn from a direction at a via point to what is next.

    Args:
        way: The direction, a unit vector, (d,).
        apart: From the via point to what is next [m], (d,).
        wanted: That is to be had where the way goes on [m].
        close: That is to be had where it goes back [m].

    >>> [aside_radius(np.array([1.0, 0]), np.array(to), 10.0, 1.0) for to in ((1, 0), (-1, 0))]
    [10.0, 1.0]
    """
    along = float(way @ apart)
    angle = math.acos(min(max(along / float(np.linalg.norm(apart)), -1.0), 1.0))
    share = min(max((BACK - angle) / (BACK - FORWARD), 0.0), 1.0)
    return max(min(close, wanted), share * wanted)
