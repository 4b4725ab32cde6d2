"""Where a body may stand and how far it may move there: a packed world seen by a row of discs.

The discs cover the body, so whatever the body would touch one of them comes too close to. Their
distances are looked up in tables of cells that are filled as they are asked: a coarse one for where
there is much room, or none at all, and a fine one. The distance is 1-Lipschitz, so an entry bounds
it in the whole cell, and only what the tables leave open is reckoned anew. Barriers are for the
reference point alone: it never gets across one.
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
COARSE_CELLS = 8  # cells aside in one of the coarse table
# columns of a disc: where it is in the robot's frame, the distance that it keeps, and by how much
# its middle moves at most while the reference point moves by one
AHEAD, LEFT, KEPT, SPEED = range(4)
# columns of a segment: curvature at its start and end, its length
FROM, TO, LENGTH = range(3)
# what is counted of distances
RECKONED, LOOKED_UP = range(2)
LOOK_UPS = 5  # of distances in tables take as long as one that is reckoned


class CollisionCache(NamedTuple):
    """A world and a body in it.

    Attributes:
        world: PackedWorld.
        frame: Outer corner of cell (0, 0) of the table: x, y; side of a cell; distance between
            the places of a path that are looked at [m], (4,).
        known: Distances in the middles of the cells, 0 where not yet reckoned, (rows, columns):
            so the memory of what is never asked is never touched.
        coarse: The same of cells that are ``COARSE_CELLS`` of those aside.
        discs: See the columns above; the first one holds the whole body, the others together
            cover it, (d, 4).
        barriers: Segments x0, y0, x1, y1 that the reference point must not cross [m], (b, 4).
        reckoned: How many distances were, so far, and how many were looked up, (2,).
    """

    world: PackedWorld
    frame: Floats
    known: Floats
    coarse: Floats
    discs: Floats
    barriers: Floats
    reckoned: Ints

    def copied(self) -> CollisionCache:
        """As far as its tables are filled: it and this one are filled each by itself."""
        return self._replace(
            known=self.known.copy(), coarse=self.coarse.copy(), reckoned=self.reckoned.copy()
        )


@inner
def looked_at(cache: CollisionCache) -> int:
    """How many distances were reckoned so far, and looked up in what takes as long."""
    return cache.reckoned[RECKONED] + cache.reckoned[LOOKED_UP] // LOOK_UPS


@inner
def _middle_distance(
    cache: CollisionCache, table: Floats, side: float, x: float, y: float
) -> tuple[float, float]:
    """Distance to the world of the middle of the cell in which a point lies, and the point's to it.

    Args:
        cache: Ground.
        table: One of its tables.
        side: Of its cells [m].
        x: The point [m].
        y: The same.

    Returns:
        Both [m]; an infinite second one for a point off the table.
    """
    column = math.floor((x - cache.frame[0]) / side)
    row = math.floor((y - cache.frame[1]) / side)
    if not (0 <= row < table.shape[0] and 0 <= column < table.shape[1]):
        return 0.0, np.inf
    middle_x = cache.frame[0] + (column + 0.5) * side
    middle_y = cache.frame[1] + (row + 0.5) * side
    value = table[row, column]
    if value == 0.0:
        value, _ = nearest(cache.world, middle_x, middle_y, np.inf)
        table[row, column] = value
        cache.reckoned[RECKONED] += 1
    return value, math.hypot(x - middle_x, y - middle_y)


@inner
def about(cache: CollisionCache, x: float, y: float) -> float:
    """Distance to the world of the middle of the cell in which a point lies; none off the table."""
    value, _ = _middle_distance(cache, cache.known, cache.frame[2], x, y)
    return value


@inner
def _distance(cache: CollisionCache, x: float, y: float, need: float) -> float:
    """Distance of a point to the world: exact or more than ``need``, or a bound, less than it."""
    side = cache.frame[2]
    wide = COARSE_CELLS * side
    value, gap = _middle_distance(cache, cache.coarse, wide, x, y)
    if value - gap >= need + wide or value + gap < need:
        return value - gap
    value, gap = _middle_distance(cache, cache.known, side, x, y)
    if value - gap >= need or value + gap < need:
        return value - gap
    cache.reckoned[RECKONED] += 1
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
        cache.reckoned[LOOKED_UP] += 1
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


@inner
def _is_blocked_along(
    cache: CollisionCache, x: float, y: float, heading: float, segments: Floats, count: int
) -> bool:
    """Whether a chain surely leads the body's greatest disc into something, as at a few places.

    What is in the way of a long chain is mostly seen so, long before its every step is looked at.
    """
    disc = cache.discs[min(1, cache.discs.shape[0] - 1)]
    wide = COARSE_CELLS * cache.frame[2]
    spacing = max(disc[KEPT], wide)
    for k in range(count):
        segment = segments[k]
        c, s = math.cos(heading), math.sin(heading)
        for j in range(1, 1 + math.ceil(segment[LENGTH] / spacing)):
            ahead = min(j * spacing, segment[LENGTH])
            dx, dy, turn = along_bend(segment[FROM], segment[TO], segment[LENGTH], ahead)
            px, py, to = x + c * dx - s * dy, y + s * dx + c * dy, heading + turn
            px += disc[AHEAD] * math.cos(to) - disc[LEFT] * math.sin(to)
            py += disc[AHEAD] * math.sin(to) + disc[LEFT] * math.cos(to)
            cache.reckoned[LOOKED_UP] += 1
            value, gap = _middle_distance(cache, cache.coarse, wide, px, py)
            if value + gap < disc[KEPT]:
                return True
        dx, dy, turn = along_bend(segment[FROM], segment[TO], segment[LENGTH], segment[LENGTH])
        x, y, heading = x + c * dx - s * dy, y + s * dx + c * dy, heading + turn
    return False


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
    if _is_blocked_along(cache, x, y, heading, segments, count):
        return False
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
