"""Bounds of the distance between a packed world and a cell of a body's motion (``body_piece``).

A cell lies in the hull of four places of body points, grown by what the hull misses. It is bounded
by a ball about a body point that is really attained, and by a capsule along its long side, which is
exact where an edge slides along itself.

Tested through ``kernels/clearance/test_footprint_walk``.
"""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Floats
from viaspline.kernels.clearance.footprint_motion import (
    COS0,
    COS1,
    EDGE,
    FROM,
    HIGH,
    LOW,
    PATH,
    SAG,
    SIN0,
    SIN1,
    SWING,
    TO,
    middle_pose,
)
from viaspline.kernels.jit import inner
from viaspline.kernels.world.distance import nearest
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.plane import squared_point_segment
from viaspline.kernels.world.segment import nearest_to_segment

POINT_SIZE_M = 1e-9  # what is smaller is a point [m]

LOWER = 0  # what is known so far: bounds of the distance [m]
UPPER = 1
AT = 2  # local parameter where the upper bound is reached, the outline's point [m], the heading
X = 3
Y = 4
COS = 5
SIN = 6
CELLS = 7  # how many have been looked at
STATE_SIZE = 8


@inner
def _corner(row: Floats, bx: float, by: float, last: bool, at: Floats, k: int) -> None:
    """Where body point (bx, by) stands at an end of a piece, into row k of ``at``."""
    c = row[COS1] if last else row[COS0]
    s = row[SIN1] if last else row[SIN0]
    end = PATH + 6 if last else PATH
    at[k, 0] = row[end] + c * bx - s * by
    at[k, 1] = row[end + 1] + s * bx + c * by


@inner
def squared_gap(at: Floats, i: int, j: int) -> float:
    """Squared distance between two corners [m²]."""
    dx = at[i, 0] - at[j, 0]
    dy = at[i, 1] - at[j, 1]
    return dx * dx + dy * dy


@inner
def _spine(at: Floats) -> float:
    """The segment that a cell's four corners are nearest to, into rows 4 and 5; how near [m].

    The corners are early and late places of the edge's ends: 0, 1 early and 2, 3 late. It is the
    longer diagonal where the edge slides along itself, else the line from side to side.
    """
    if squared_gap(at, 0, 3) > squared_gap(at, 1, 2):
        i, j, k, m = 0, 3, 1, 2
    else:
        i, j, k, m = 1, 2, 0, 3
    diagonal = max(
        squared_point_segment(at[k, 0], at[k, 1], at[i, 0], at[i, 1], at[j, 0], at[j, 1]),
        squared_point_segment(at[m, 0], at[m, 1], at[i, 0], at[i, 1], at[j, 0], at[j, 1]),
    )
    a, b, c, d = 0, 1, 2, 3
    if squared_gap(at, 0, 1) + squared_gap(at, 2, 3) > squared_gap(at, 0, 2) + squared_gap(
        at, 1, 3
    ):
        b, c = 2, 1
    for axis in range(2):
        at[4, axis] = 0.5 * (at[a, axis] + at[b, axis])
        at[5, axis] = 0.5 * (at[c, axis] + at[d, axis])
    across = 0.0
    for q in range(4):
        across = max(
            across,
            squared_point_segment(at[q, 0], at[q, 1], at[4, 0], at[4, 1], at[5, 0], at[5, 1]),
        )
    if diagonal <= across:
        for axis in range(2):
            at[4, axis] = at[i, axis]
            at[5, axis] = at[j, axis]
    return math.sqrt(min(diagonal, across))


@inner
def cell_bound(
    world: PackedWorld, body: Floats, row: Floats, state: Floats, accept: float, at: Floats
) -> tuple[float, int, int]:
    """Bound the distance of a cell; a body point's distance goes into ``state`` if it is less.

    Returns:
        (lower bound [m], how to go on, index or -1): by halving the motion 1, the edge 2, and 0
        where the cell is a point.
    """
    edge = int(row[EDGE])
    ax, ay = body[edge, 0], body[edge, 1]
    after = edge + 1 if edge + 1 < body.shape[0] else 0
    dx, dy = body[after, 0] - ax, body[after, 1] - ay
    reach = 0.0
    for k in range(2):
        t = row[HIGH] if k == 1 else row[LOW]
        bx, by = ax + t * dx, ay + t * dy
        reach = max(reach, bx * bx + by * by)
        _corner(row, bx, by, False, at, k)
        _corner(row, bx, by, True, at, 2 + k)
    missed = row[SAG] + math.sqrt(reach) * row[SWING]
    x, y, c, s = middle_pose(row)
    t = 0.5 * (row[LOW] + row[HIGH])
    bx, by = ax + t * dx, ay + t * dy
    px, py = x + c * bx - s * by, y + s * bx + c * by
    ball = 0.0
    for k in range(4):
        ball = max(ball, (at[k, 0] - px) ** 2 + (at[k, 1] - py) ** 2)
    ball = math.sqrt(ball) + missed
    distance, index = nearest(world, px, py, state[UPPER] + ball)
    if distance < state[UPPER]:
        state[UPPER] = distance
        state[AT] = 0.5 * (row[FROM] + row[TO])
        state[X], state[Y] = px, py
        state[COS], state[SIN] = c, s
    else:
        index = -1
    bound = distance - ball
    along = max(squared_gap(at, 0, 2), squared_gap(at, 1, 3))
    if bound >= accept or ball < POINT_SIZE_M:
        return bound, 0, index
    width = _spine(at) + missed
    if distance - width >= accept and state[UPPER] > 0.0:
        chord, _ = nearest_to_segment(
            world, at[4, 0], at[4, 1], at[5, 0], at[5, 1], state[UPPER] + width
        )
        if chord > 0.0:
            bound = max(bound, chord - width)
    too_coarse = missed > max(0.5 * width, 0.25 * (distance - accept))
    by_motion = too_coarse or along >= squared_gap(at, 0, 1)
    return bound, 1 if by_motion else 2, index
