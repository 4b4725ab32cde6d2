"""Where a string's tangents and arcs come too close to the world.

Tested through ``kernels/routing/string_pulling/test_pull``.
"""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import fused, uncounted
from viaspline.kernels.routing.tangent_arcs import (
    BEND_RADIUS,
    BEND_X,
    BEND_Y,
    HEADING_IN,
    SIDE,
    TURN,
)
from viaspline.kernels.world.distance import nearest
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.segment import nearest_to_segment

SAME_DISTANCE_M = 1e-9  # [m]
CLOSE_SHARE = 0.02  # of the distance that is kept: how exactly the place of a conflict is told


@uncounted
def closest_on(
    world: PackedWorld, ax: float, ay: float, bx: float, by: float, floor: float, within: float
) -> tuple[float, float]:
    """A place on a segment near which it comes closer than ``floor`` to the world, the first one.

    Args:
        world: PackedWorld.
        ax: The segment's one end [m].
        ay: Of that, the other coordinate [m].
        bx: The segment's other end [m].
        by: Of that, the other coordinate [m].
        floor: Distance to keep [m].
        within: How exactly the place is told [m].
    """
    size = math.hypot(bx - ax, by - ay)
    while size > within + SAME_DISTANCE_M:
        mx = 0.5 * (ax + bx)
        my = 0.5 * (ay + by)
        distance, _ = nearest_to_segment(world, ax, ay, mx, my, floor)
        if distance < floor:
            bx = mx
            by = my
        else:
            ax = mx
            ay = my
        size *= 0.5
    return 0.5 * (ax + bx), 0.5 * (ay + by)


@uncounted
def arc_conflict(
    world: PackedWorld, rows: Floats, k: int, begin: float, end: float, floor: float
) -> tuple[float, float, float]:
    """Where the arc of row k comes too close to something: place and turn so far.

    Args:
        world: PackedWorld.
        rows: The string.
        k: The row.
        begin: Turn at which the arc begins, from the heading with which the string comes [rad].
        end: Turn at which it ends [rad].
        floor: Distance to keep [m].

    Returns:
        (x [m], y [m], turn [rad]); the turn is below 0 where the arc is clear.
    """
    turn = begin
    radius = rows[k, BEND_RADIUS]
    while turn < end:
        heading = rows[k, HEADING_IN] + rows[k, SIDE] * turn
        x = rows[k, BEND_X] + rows[k, SIDE] * radius * math.sin(heading)
        y = rows[k, BEND_Y] - rows[k, SIDE] * radius * math.cos(heading)
        distance, _ = nearest(world, x, y, floor + radius)
        if distance < floor:
            return x, y, turn
        turn += max(0.02, (distance - floor) / radius)
    return 0.0, 0.0, -1.0


@fused
def _conflict(
    world: PackedWorld, rows: Floats, k: int, floor: float
) -> tuple[int, float, float, float]:
    """Where the tangent after row k, or the arc of row k, comes closer than ``floor``.

    Returns:
        (row after which something is missing, heading there, x, y); -1 where both are clear.
    """
    heading = rows[k + 1, HEADING_IN]
    reach = rows[k, SIDE] * rows[k, BEND_RADIUS]
    ax = rows[k, BEND_X] + reach * math.sin(heading)
    ay = rows[k, BEND_Y] - reach * math.cos(heading)
    reach = rows[k + 1, SIDE] * rows[k + 1, BEND_RADIUS]
    bx = rows[k + 1, BEND_X] + reach * math.sin(heading)
    by = rows[k + 1, BEND_Y] - reach * math.cos(heading)
    distance, _ = nearest_to_segment(world, ax, ay, bx, by, floor)
    if distance < floor:
        x, y = closest_on(world, ax, ay, bx, by, floor, CLOSE_SHARE * floor)
        return k, heading, x, y
    x, y, turned = arc_conflict(world, rows, k, 0.0, rows[k, TURN], floor)
    if turned < 0.0:
        return -1, heading, x, y
    at = k if turned >= 0.5 * rows[k, TURN] else k - 1
    return at, rows[k, HEADING_IN] + rows[k, SIDE] * turned, x, y


@fused
def next_conflict(
    world: PackedWorld, rows: Floats, count: int, k: int, floor: float
) -> tuple[int, int, float, float, float]:
    """The first conflict of a string from row k on, and round to it again.

    Returns:
        (row, and what ``_conflict`` says of it).
    """
    for i in range(count - 1):
        row = (k + i) % (count - 1)
        at, heading, x, y = _conflict(world, rows, row, floor)
        if at >= 0:
            return row, at, heading, x, y
    return 0, -1, 0.0, 0.0, 0.0
