"""What a way costs at least that passes solids on one side each, for a search to begin with.

Without it a search for a way over a roof looks at all that is about in front of the building, since
from there the goal seems to be near. Tested through ``kernels/space/routing/test_side_gates``.
"""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined, inner, kernel
from viaspline.kernels.space.routing.side_gates import (
    AHEAD_X,
    AHEAD_Y,
    ALLOWED,
    GATE_X,
    GATE_Y,
    LEAST,
    LEFT,
    MIDDLE_Z,
    MOST,
    OVER,
    RIGHT,
    UNDER,
    ahead_of,
)
from viaspline.kernels.space.routing.travel_norm import travel


@inlined
def _travel(norm: Floats, level: float, rise: float, fall: float) -> float:
    """Cost of a way that goes so far level, up and down [m], each at once."""
    length = math.sqrt(level * level + (rise + fall) ** 2)
    if norm[0] <= 0.0:
        return length
    return max(length / norm[0], rise / norm[1] + fall / norm[2])


@inner
def travel_past(
    gates: Floats, norm: Floats, x: float, y: float, z: float, to_x: float, to_y: float, to_z: float
) -> float:
    """Least cost of a way between two places that crosses each gate between them where it may.

    Args:
        gates: See ``side_gates``, (g, 8).
        norm: See ``travel_norm``, (3,).
        x: Where it begins [m].
        y: Likewise.
        z: Likewise.
        to_x: Where it ends [m].
        to_y: Likewise.
        to_z: Likewise.
    """
    least = travel(norm, to_x - x, to_y - y, to_z - z)
    level = math.hypot(to_x - x, to_y - y)
    for g in range(gates.shape[0]):
        first, last = ahead_of(gates, g, x, y), ahead_of(gates, g, to_x, to_y)
        if (first < 0.0) == (last < 0.0):
            continue
        allowed = int(gates[g, ALLOWED])
        rise, fall, around = max(to_z - z, 0.0), max(z - to_z, 0.0), level
        if allowed == OVER:
            rise = max(gates[g, MIDDLE_Z] - z, rise)
            fall = max(gates[g, MIDDLE_Z] - to_z, fall)
        elif allowed == UNDER:
            fall = max(z - gates[g, MIDDLE_Z], fall)
            rise = max(to_z - gates[g, MIDDLE_Z], rise)
        elif allowed in (LEFT, RIGHT):
            own = gates[g, AHEAD_X] * (y - gates[g, GATE_Y])
            own -= gates[g, AHEAD_Y] * (x - gates[g, GATE_X])
            other = gates[g, AHEAD_X] * (to_y - gates[g, GATE_Y])
            other -= gates[g, AHEAD_Y] * (to_x - gates[g, GATE_X])
            crossed = own + first / (first - last) * (other - own)
            edge = gates[g, MOST] if allowed == LEFT else gates[g, LEAST]
            if (crossed < edge) if allowed == LEFT else (crossed > edge):
                around = math.hypot(first, own - edge) + math.hypot(last, other - edge)
        least = max(least, _travel(norm, around, rise, fall))
    return least


@kernel
def least_travel(gates: Floats, norm: Floats, start: Floats, goal: Floats) -> float:
    """See ``travel_past``, from one place [m], (3,), to another."""
    return travel_past(gates, norm, start[0], start[1], start[2], goal[0], goal[1], goal[2])
