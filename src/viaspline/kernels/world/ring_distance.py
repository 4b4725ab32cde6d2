"""A rounded ring: how far from it a point, a segment or another ring is, and which cells it covers.

Signed distances are exact outside, and inside the depth below the surface; they are 1-Lipschitz. A
query's ``limit`` is answered where the ring is farther away than that.

Tested through ``kernels/world/test_shape``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Bytes, Floats
from viaspline.kernels.jit import inlined, uncounted
from viaspline.kernels.world.packed import PackedRings, PackedWorld
from viaspline.kernels.world.plane import (
    box_gap,
    box_signed,
    point_segment,
    segment_segment,
    squared_point_segment,
)


@inlined
def is_disc(world: PackedRings, r: int) -> bool:
    """Whether ring r is a single vertex."""
    return world.heads[r, 3] == 1.0


@inlined
def radius_of(world: PackedRings, r: int) -> float:
    """By how much the core of ring r is grown [m]."""
    return world.heads[r, 2]


@inlined
def crosses_eastwards(edges: Floats, e: int, x: float, y: float) -> bool:
    """Whether the ray from (x, y) to the east crosses edge e."""
    y0 = edges[e, 1]
    y1 = edges[e, 3]
    if (y0 > y) == (y1 > y):
        return False
    return x < edges[e, 0] + (y - y0) / (y1 - y0) * (edges[e, 2] - edges[e, 0])


@inlined
def _core_signed(world: PackedRings, r: int, x: float, y: float) -> float:
    """Signed distance from (x, y) to the core of ring r [m]; negative inside."""
    boxes = world.block_boxes
    inside = False
    best = np.inf
    squared = np.inf
    for b in range(world.ring_blocks[r], world.ring_blocks[r + 1]):
        near = box_signed(boxes, b, x, y) < best
        ray = boxes[b, 1] <= y <= boxes[b, 3] and x <= boxes[b, 2]
        if not (near or ray):
            continue
        for e in range(world.block_edges[b], world.block_edges[b + 1]):
            edge = world.edges[e]
            if near:
                other = squared_point_segment(x, y, edge[0], edge[1], edge[2], edge[3])
                squared = min(squared, other)
            if ray and crosses_eastwards(world.edges, e, x, y):
                inside = not inside
        best = math.sqrt(squared)
    return -best if inside else best


@inlined
def ring_signed(world: PackedRings, r: int, x: float, y: float, limit: float) -> float:
    """Signed distance from (x, y) to ring r [m]; negative inside."""
    if is_disc(world, r):
        dx = x - world.heads[r, 0]
        dy = y - world.heads[r, 1]
        return math.sqrt(dx * dx + dy * dy) - world.heads[r, 2]
    return min(_core_signed(world, r, x, y) - world.heads[r, 2], limit)


@inlined
def ring_segment(
    world: PackedWorld, r: int, ax: float, ay: float, bx: float, by: float, limit: float
) -> float:
    """Distance between ring r and the segment a-b [m].

    Where the segment touches the core, or lies inside of it, that is less the radius: 0 for a
    polygon; exact for a disc.
    """
    radius = world.heads[r, 2]
    if is_disc(world, r):
        return point_segment(world.heads[r, 0], world.heads[r, 1], ax, ay, bx, by) - radius
    x0 = min(ax, bx)
    x1 = max(ax, bx)
    y0 = min(ay, by)
    y1 = max(ay, by)
    reach = limit + radius
    best = reach
    for b in range(world.ring_blocks[r], world.ring_blocks[r + 1]):
        if box_gap(world.block_boxes, b, x0, y0, x1, y1) >= best:
            continue
        for e in range(world.block_edges[b], world.block_edges[b + 1]):
            edge = world.edges[e]
            gap = segment_segment(ax, ay, bx, by, edge[0], edge[1], edge[2], edge[3])
            best = min(best, gap)
    if best > 0.0 and _core_signed(world, r, ax, ay) < 0.0:
        best = 0.0
    return best - radius if best < reach else limit


@uncounted
def rings_gap(world: PackedWorld, r: int, q: int, limit: float) -> float:
    """Distance between the rings r and q [m]; not above 0 where they overlap."""
    best = limit
    for one, other in ((r, q), (q, r)):
        radius = radius_of(world, one)
        for e in range(world.ring_edges[one], world.ring_edges[one + 1]):
            edge = world.edges[e]
            reach = best + radius
            gap = ring_segment(world, other, edge[0], edge[1], edge[2], edge[3], reach)
            if gap < reach:  # rounding must not bring nearer what is farther than the limit
                best = min(best, gap - radius)
    return best


@uncounted
def mark_disc(
    world: PackedWorld, r: int, x: float, y: float, side: float, reach: float, cells: Bytes
) -> None:
    """Block the cells whose middle is nearer than ``reach`` to a disc, row by row."""
    height, width = cells.shape
    center = world.heads[r]
    radius = center[2] + reach
    first = max(0, int(np.floor((center[1] - radius - y) / side)))
    last = min(height, int(np.ceil((center[1] + radius - y) / side)))
    for row in range(first, last):
        rise = y + (row + 0.5) * side - center[1]
        if rise * rise >= radius * radius:
            continue
        half = np.sqrt(radius * radius - rise * rise)
        left = max(0, int(np.ceil((center[0] - half - x) / side - 0.5)))
        right = min(width - 1, int(np.floor((center[0] + half - x) / side - 0.5)))
        for column in range(left, right + 1):
            cells[row, column] = 1
