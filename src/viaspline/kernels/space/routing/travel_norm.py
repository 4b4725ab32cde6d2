"""What a straight way costs: its length, or the time that it takes at limited speeds.

Both are convex norms of the step, so a search and a string pulled taut serve either.

Tested through ``kernels/space/routing/test_pull_taut``.
"""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined


@inlined
def travel(norm: Floats, dx: float, dy: float, dz: float) -> float:
    """Cost of a straight way.

    Args:
        norm: Greatest speed, climbing and sinking speed [m/s], (3,); the cost is a length where
            the first is 0.
        dx: Eastward part [m].
        dy: Northward part [m].
        dz: Upward part [m].

    Returns:
        [m] or [s].
    """
    level = dx * dx + dy * dy
    if norm[0] <= 0.0:
        return math.sqrt(level + dz * dz)
    upright = dz / norm[1] if dz > 0.0 else -dz / norm[2]
    return max(math.sqrt(level + dz * dz) / norm[0], upright)


@inlined
def travel_between(norm: Floats, places: Floats, i: int, j: int) -> float:
    """Cost of the straight way from one row of places, (n, 3), to another."""
    dx = places[j, 0] - places[i, 0]
    dy = places[j, 1] - places[i, 1]
    return travel(norm, dx, dy, places[j, 2] - places[i, 2])
