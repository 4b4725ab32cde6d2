"""Where a body may stand and how far it may move there: a packed world seen by a row of discs.

The discs cover the body, so whatever the body would touch one of them comes too close to. Their
distances are looked up in a table of cells that is filled as it is asked; the distance is
1-Lipschitz, so an entry bounds it in the whole cell, and only what that leaves open is reckoned
anew. Barriers are for the reference point alone: it never gets across one.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.turning.curvature_ramp import along_bend
from viaspline.kernels.world.distance import nearest
from viaspline.kernels.world.packed import PackedWorld

HALF_DIAGONAL_CELLS = math.sqrt(0.5)
# columns of a disc: where it is in the robot's frame, the distance that it keeps, and by how much
# its middle moves at most while the reference point moves by one
AHEAD, LEFT, KEPT, SPEED = range(4)
# columns of a segment: curvature at its start and end, its length
FROM, TO, LENGTH = range(3)


class CollisionCache(NamedTuple):
    """A world and a body in it.

    Attributes:
        world: PackedWorld.
        frame: Outer corner of cell (0, 0) of the table: x, y; side of a cell; distance between
            the places of a path that are looked at [m], (4,).
        known: Distances in the middles of the cells, 0 where not yet reckoned, (rows, columns):
            so the memory of what is never asked is never touched.
        discs: See the columns above; the first one holds the whole body, the others together
            cover it, (d, 4).
        barriers: Segments x0, y0, x1, y1 that the reference point must not cross [m], (b, 4).
        reckoned: How many distances were, so far, (1,).
    """

    world: PackedWorld
    frame: Floats
    known: Floats
    discs: Floats
    barriers: Floats
    reckoned: Ints


@inner
def about(cache: CollisionCache, x: float, y: float) -> float:
    """Distance to the world of the middle of the cell in which a point lies; none off the table."""
    side = cache.frame[2]
    column = math.floor((x - cache.frame[0]) / side)
    row = math.floor((y - cache.frame[1]) / side)
    if not (0 <= row < cache.known.shape[0] and 0 <= column < cache.known.shape[1]):
        return 0.0
    value = cache.known[row, column]
    if value == 0.0:
        middle_x = cache.frame[0] + (column + 0.5) * side
        middle_y = cache.frame[1] + (row + 0.5) * side
        value, _ = nearest(cache.world, middle_x, middle_y, np.inf)
        cache.known[row, column] = value
        cache.reckoned[0] += 1
    return value


@inner
def _distance(cache: CollisionCache, x: float, y: float, need: float) -> float:
    """Distance of a point to the world: exact or more than ``need``, or a bound, less than it."""
    side = cache.frame[2]
    column = math.floor((x - cache.frame[0]) / side)
    row = math.floor((y - cache.frame[1]) / side)
    if 0 <= row < cache.known.shape[0] and 0 <= column < cache.known.shape[1]:
        middle_x = cache.frame[0] + (column + 0.5) * side
        middle_y = cache.frame[1] + (row + 0.5) * side
        value = about(cache, x, y)
        gap = math.hypot(x - middle_x, y - middle_y)
        if value - gap >= need or value + gap < need:
            return value - gap
    cache.reckoned[0] += 1
    value, _ = nearest(cache.world, x, y, need + 4.0 * side)
    return value


@inner
def _barrier_gap(barriers: Floats, x: float, y: float) -> float:
    """Distance of a point to the nearest barrier; infinite where there is none."""
    least = np.inf
    for k in range(barriers.shape[0]):
        ax, ay = x - barriers[k, 0], y - barriers[k, 1]
        dx, dy = barriers[k, 2] - barriers[k, 0], barriers[k, 3] - barriers[k, 1]
        size = dx * dx + dy * dy
        w = min(1.0, max(0.0, (ax * dx + ay * dy) / size)) if size > 0.0 else 0.0
        least = min(least, math.hypot(ax - w * dx, ay - w * dy))
    return least


@inner
def reach(cache: CollisionCache, x: float, y: float, c: float, s: float) -> float:
    """How far the body can surely move on from a pose, whichever way it turns [m].

    Args:
        cache: Ground.
        x: The reference point [m].
        y: The same.
        c: Cosine of the heading.
        s: Sine of the heading.

    Returns:
        Less than half the distance between two places that are looked at: it is too close.
    """
    half = 0.5 * cache.frame[3]
    least = _barrier_gap(cache.barriers, x, y)
    if least < half:
        return least
    for i in range(cache.discs.shape[0]):
        disc = cache.discs[i]
        px = x + c * disc[AHEAD] - s * disc[LEFT]
        py = y + s * disc[AHEAD] + c * disc[LEFT]
        need = disc[KEPT] + half * disc[SPEED]
        room = (_distance(cache, px, py, need) - disc[KEPT]) / disc[SPEED]
        if i == 0:
            if room >= half or cache.discs.shape[0] == 1:
                return min(room, least)
        else:
            least = min(least, room)
            if room < half:
                return room
    return least


@kernel
def is_clear(
    cache: CollisionCache, x: float, y: float, heading: float, segments: Floats, count: int
) -> bool:
    """Whether the body surely gets along a chain of segments.

    Args:
        cache: Ground.
        x: Where the chain starts [m].
        y: The same.
        heading: The same [rad].
        segments: See the columns above, (n, 3).
        count: How many of them count.
    """
    half = 0.5 * cache.frame[3]
    ahead = 0.0
    for k in range(count):
        segment = segments[k]
        while ahead <= segment[LENGTH]:
            dx, dy, turn = along_bend(segment[FROM], segment[TO], segment[LENGTH], ahead)
            c, s = math.cos(heading), math.sin(heading)
            room = reach(
                cache, x + c * dx - s * dy, y + s * dx + c * dy,
                math.cos(heading + turn), math.sin(heading + turn),
            )  # fmt: skip
            if room < half:
                return False
            ahead += room + half
        ahead -= segment[LENGTH]
        dx, dy, turn = along_bend(segment[FROM], segment[TO], segment[LENGTH], segment[LENGTH])
        c, s = math.cos(heading), math.sin(heading)
        x, y, heading = x + c * dx - s * dy, y + s * dx + c * dy, heading + turn
    return reach(cache, x, y, math.cos(heading), math.sin(heading)) >= half
