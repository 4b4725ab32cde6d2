"""Places at which a short way may turn: beside corners, over roofs, round cables and balls.

They needn't be exact: a way through them is pulled taut afterwards. They say on which side of what
the way goes.

Tested through ``kernels/space/routing/test_contact_graph``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inlined, inner
from viaspline.kernels.space.height_limits import heights_allowed
from viaspline.kernels.space.packed_space import LINE, PRISM, PackedSpace
from viaspline.kernels.space.space_distance import space_distance
from viaspline.kernels.world.ring_distance import is_disc

_OFF = 1.01  # times the distance to be kept
_SHARPEST = 0.3  # cosine of half the turn at a corner, for how far off it a place is put
_ROUND = 8  # places round a disc
_LEVELS = 4  # heights at an upright edge
_ALONG = 3  # places along an edge of a roof
_LONGEST_OUTLINE = 64


@inner
def _add(
    space: PackedSpace, radius: float, x: float, y: float, z: float, places: Floats, size: Ints
) -> None:
    """Add a place, if it is free and there is room for it; beyond all heights there is none."""
    if size[0] == places.shape[0] or not math.isfinite(z):
        return
    low, high = heights_allowed(space, x, y)
    if not low <= z <= high or space_distance(space, x, y, z, radius)[0] < radius:
        return
    places[size[0], 0] = x
    places[size[0], 1] = y
    places[size[0], 2] = z
    size[0] += 1


@inner
def _outline(space: PackedSpace, r: int, off: float, corners: Floats) -> int:
    """Write places off the corners of a ring that stick out; how many there are."""
    if is_disc(space, r):
        reach = (off + space.heads[r, 2]) / math.cos(math.pi / _ROUND)
        for k in range(_ROUND):
            corners[k, 0] = space.heads[r, 0] + reach * math.cos(2.0 * math.pi * k / _ROUND)
            corners[k, 1] = space.heads[r, 1] + reach * math.sin(2.0 * math.pi * k / _ROUND)
        return _ROUND
    edges = space.edges
    reach = off + space.heads[r, 2]
    first = space.block_edges[space.ring_blocks[r]]
    last = space.block_edges[space.ring_blocks[r + 1]] - 1
    before = last
    count = 0
    for e in range(first, last + 1):
        if edges[e, 0] != edges[before, 2] or edges[e, 1] != edges[before, 3]:
            before = e - 1 if e > first else last
        ax = edges[before, 2] - edges[before, 0]
        ay = edges[before, 3] - edges[before, 1]
        bx = edges[e, 2] - edges[e, 0]
        by = edges[e, 3] - edges[e, 1]
        a = math.hypot(ax, ay)
        b = math.hypot(bx, by)
        before = e
        if a == 0.0 or b == 0.0:
            continue
        turn = (ax * by - ay * bx) / (a * b)
        straight = (ax * bx + ay * by) / (a * b)
        if turn < 1e-3 and straight > -0.999:
            continue
        nx = ay / a + by / b
        ny = -ax / a - bx / b
        size = math.hypot(nx, ny)
        if size < 1e-6:  # the end of a wall: ahead of it
            nx = ax / a
            ny = ay / a
            size = 1.0
        share = reach / (size * max(0.5 * size, _SHARPEST))
        corners[count, 0] = edges[e, 0] + share * nx
        corners[count, 1] = edges[e, 1] + share * ny
        count += 1
        if count == corners.shape[0]:
            break
    return count


@inlined
def _share_of_way(ends: Floats, x: float, y: float) -> float:
    """How far on the line between two ends, rows of (2, 3), a place lies in plan, 0 to 1."""
    dx = ends[1, 0] - ends[0, 0]
    dy = ends[1, 1] - ends[0, 1]
    square = dx * dx + dy * dy
    if square == 0.0:
        return 0.5
    along = (x - ends[0, 0]) * dx + (y - ends[0, 1]) * dy
    return min(max(along / square, 0.0), 1.0)


@inner
def _about_prism(
    space: PackedSpace, r: int, radius: float, ends: Floats, places: Floats, size: Ints
) -> None:
    """Places at the corners of a prism, and along the edges of its roof and floor."""
    off = _OFF * (radius + space.core[0]) + 1e-6
    up = _OFF * (radius + space.core[1]) + 1e-6
    top = space.ring_heights[r, 1] + up
    bottom = space.ring_heights[r, 0] - up
    corners = np.empty((_LONGEST_OUTLINE, 2))
    count = _outline(space, r, off, corners)
    for c in range(count):
        x = corners[c, 0]
        y = corners[c, 1]
        t = _share_of_way(ends, x, y)
        z = ends[0, 2] + t * (ends[1, 2] - ends[0, 2])
        low, high = heights_allowed(space, x, y)
        level = min(max(z, low), high)
        _add(space, radius, x, y, level, places, size)
        roof = min(top, high)
        for step in range(1, _LEVELS):
            if abs(roof - level) > 1.0:
                _add(
                    space, radius, x, y, level + (roof - level) * step / (_LEVELS - 1), places, size
                )
        other = (c + 1) % count
        for level in (top, bottom):
            if low <= level <= high:
                for step in range(_ALONG):
                    s = (step + 0.5) / _ALONG
                    u = x + s * (corners[other, 0] - x)
                    v = y + s * (corners[other, 1] - y)
                    _add(space, radius, u, v, level, places, size)


@inner
def _about_line(
    space: PackedSpace, k: int, radius: float, ends: Floats, places: Floats, size: Ints
) -> None:
    """Places round a cable or a ball."""
    lines = space.lines
    off = _OFF * (radius + lines[k, 6] + math.hypot(space.core[0], space.core[1])) + 1e-6
    dx = lines[k, 3] - lines[k, 0]
    dy = lines[k, 4] - lines[k, 1]
    dz = lines[k, 5] - lines[k, 2]
    length = math.sqrt(dx * dx + dy * dy + dz * dz)
    stops = 5
    if length == 0.0:  # round a ball, across the line between the ends
        stops = 1
        dx = ends[1, 0] - ends[0, 0]
        dy = ends[1, 1] - ends[0, 1]
        dz = ends[1, 2] - ends[0, 2]
        length = math.sqrt(dx * dx + dy * dy + dz * dz)
        if length == 0.0:
            return
    ax = -dy
    ay = dx
    level = math.hypot(ax, ay)
    if level < 1e-9 * length:
        ax = 1.0
        ay = 0.0
        level = 1.0
    ax /= level
    ay /= level
    bx = -dz * ay / length
    by = dz * ax / length
    bz = (dx * ay - dy * ax) / length
    reach = off / math.cos(math.pi / _ROUND)
    for stop in range(stops):
        s = stop / (stops - 1) if stops > 1 else 0.0
        x = lines[k, 0] + s * (lines[k, 3] - lines[k, 0])
        y = lines[k, 1] + s * (lines[k, 4] - lines[k, 1])
        z = lines[k, 2] + s * (lines[k, 5] - lines[k, 2])
        for turn in range(_ROUND):
            p = reach * math.cos(2.0 * math.pi * turn / _ROUND)
            q = reach * math.sin(2.0 * math.pi * turn / _ROUND)
            _add(space, radius, x + p * ax + q * bx, y + p * ay + q * by, z + q * bz, places, size)


@inner
def add_contacts(
    space: PackedSpace, i: int, radius: float, ends: Floats, places: Floats, size: Ints
) -> None:
    """Add the places at which a way may turn at a solid.

    Args:
        space: What stands about.
        i: The solid.
        radius: To be kept from everything [m].
        ends: Start and goal [m], (2, 3).
        places: Rows are added to these [m], (n, 3).
        size: How many there are, (1,).
    """
    if space.kinds[i] == PRISM:
        _about_prism(space, space.rows[i], radius, ends, places, size)
    elif space.kinds[i] == LINE:
        _about_line(space, space.rows[i], radius, ends, places, size)
