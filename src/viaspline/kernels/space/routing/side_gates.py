"""On which side of an obstacle a way passes: where it crosses the obstacle's gate.

The gate of an obstacle is the upright plane through its middle, across the line from start to goal
in plan. What the obstacle is seen to cover of it, grown by the radius, is the opening's sill: a
crossing is left of it, right of it, or else over or under its middle. A way passes an obstacle on
a side if every crossing of the gate lies on that side. Where start and goal lie on the same side
of the gate, a way needs not cross it at all.

Tested through ``kernels/space/routing/test_lazy_theta``.
"""

from __future__ import annotations

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined

LEFT, RIGHT, OVER, UNDER = 1, 2, 4, 8
"""Bits of the sides on which an obstacle may be passed."""

GATE_X, GATE_Y, AHEAD_X, AHEAD_Y, LEAST, MOST, MIDDLE_Z, ALLOWED = range(8)
"""Columns of gates: a place of the plane in plan [m], the direction in which it is crossed, from
where to where along the plane the obstacle reaches, to the left [m], the height between over and
under [m], and the sides that are allowed."""


@inlined
def side_at(gates: Floats, g: int, x: float, y: float, z: float) -> int:
    """The side of a gate on which a place of its plane lies."""
    left = gates[g, AHEAD_X] * (y - gates[g, GATE_Y]) - gates[g, AHEAD_Y] * (x - gates[g, GATE_X])
    if left > gates[g, MOST]:
        return LEFT
    if left < gates[g, LEAST]:
        return RIGHT
    return OVER if z > gates[g, MIDDLE_Z] else UNDER


@inlined
def ahead_of(gates: Floats, g: int, x: float, y: float) -> float:
    """How far a place lies behind the plane of a gate, seen from the start [m]."""
    ahead = gates[g, AHEAD_X] * (x - gates[g, GATE_X])
    return ahead + gates[g, AHEAD_Y] * (y - gates[g, GATE_Y])


@inlined
def gates_allow(
    gates: Floats, x: float, y: float, z: float, dx: float, dy: float, dz: float
) -> bool:
    """Whether a straight way crosses gates, (g, 8), on allowed sides only."""
    for g in range(gates.shape[0]):
        first = ahead_of(gates, g, x, y)
        last = ahead_of(gates, g, x + dx, y + dy)
        if (first < 0.0) == (last < 0.0):
            continue
        t = first / (first - last)
        if int(gates[g, ALLOWED]) & side_at(gates, g, x + t * dx, y + t * dy, z + t * dz) == 0:
            return False
    return True
