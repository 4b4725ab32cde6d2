"""Corners: where a shortest route round inflated obstacles can turn.

Inflated by ``rho`` a rounded ring is bounded by arcs: a disc made larger, or an arc about every
convex vertex, the straight pieces between them being tangents. Each arc is
wrapped in a few circumscribed corners. A corner knows its arc, so that a route of corners can be
pulled taut onto the true arcs afterwards.

Tested through ``kernels/routing/test_tangent_graph``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import uncounted
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.ring_distance import is_disc, radius_of

# columns of a corner
X, Y, CENTER_X, CENTER_Y, RADIUS, NORMAL_X, NORMAL_Y, SLOPE = range(8)
CORNER_COLUMNS = 8
ROUNDING = 1e-15  # of what a coordinate is, by which it may be off


@uncounted
def _fan(
    corners: Floats,
    count: int,
    x: float,
    y: float,
    radius: float,
    first: float,
    turn: float,
    step: float,
) -> int:
    """Write the corners of one arc: ``turn`` [rad] from the direction ``first`` about (x, y)."""
    parts = max(1, int(np.ceil(turn / step - 1e-9)))
    half = 0.5 * turn / parts
    reach = radius / math.cos(half)
    slope = math.tan(half)
    for k in range(parts):
        angle = first + (2 * k + 1) * half
        nx = math.cos(angle)
        ny = math.sin(angle)
        if count < corners.shape[0]:
            corners[count, X] = x + reach * nx
            corners[count, Y] = y + reach * ny
            corners[count, CENTER_X] = x
            corners[count, CENTER_Y] = y
            corners[count, RADIUS] = radius
            corners[count, NORMAL_X] = nx
            corners[count, NORMAL_Y] = ny
            corners[count, SLOPE] = slope
        count += 1
    return count


@uncounted
def _ring_corners(
    edges: Floats, first: int, last: int, rho: float, step: float, corners: Floats, count: int
) -> int:
    """Corners of rings that follow each other, each starting where the last closed."""
    ring = first
    for e in range(first, last):
        edge = edges[e]
        if edge[2] == edges[ring, 0] and edge[3] == edges[ring, 1]:
            following = ring  # the ring is closed
            ring = e + 1
        else:
            following = e + 1
        after = edges[following]
        ux = edge[2] - edge[0]
        uy = edge[3] - edge[1]
        vx = after[2] - after[0]
        vy = after[3] - after[1]
        across = ux * vy - uy * vx
        along = ux * vx + uy * vy
        # a line goes back at its ends, and which sign the 0 has there depends on how it lies
        turn = math.pi if across == 0.0 and along < 0.0 else math.atan2(across, along)
        if turn > 1e-12:  # free space lies to the right of every edge: convex corners turn left
            outward = math.atan2(-ux, uy)
            count = _fan(corners, count, edge[2], edge[3], rho, outward, turn, step)
    return count


@uncounted
def ring_fans(
    world: PackedWorld, r: int, rho: float, step: float, corners: Floats, count: int
) -> int:
    """Append the corners of ring r; see ``shape.obstacle_corners``."""
    radius = radius_of(world, r) + rho
    if is_disc(world, r):
        center = world.heads[r]
        return _fan(corners, count, center[0], center[1], radius, 0.0, 2 * np.pi, 0.5 * step)
    first = world.ring_edges[r]
    last = world.ring_edges[r + 1]
    return _ring_corners(world.edges, first, last, radius, step, corners, count)


@uncounted
def fence_corners(world: PackedWorld, rho: float, step: float, corners: Floats, count: int) -> int:
    """Append the corners of fences, where they aren't convex; see ``shape.obstacle_corners``."""
    for f in range(world.fence_edges.size - 1):
        first = world.fence_edges[f]
        last = world.fence_edges[f + 1]
        count = _ring_corners(world.fences, first, last, rho, step, corners, count)
    return count


@uncounted
def supports(corners: Floats, k: int, dx: float, dy: float) -> bool:
    """Whether a line through corner k along (dx, dy) leaves its obstacle on one side.

    Only there can a taut route come in or go out.
    """
    nx = corners[k, NORMAL_X]
    ny = corners[k, NORMAL_Y]
    along = dx * nx + dy * ny
    across = dx * ny - dy * nx
    # the corner's edges lie behind its tangent by an angle whose tangent is SLOPE, to either side
    rounding = ROUNDING * (abs(corners[k, X]) + abs(corners[k, Y]))  # far off the origin it counts
    return abs(along) <= abs(across) * corners[k, SLOPE] + 1e-9 * (abs(dx) + abs(dy)) + rounding
