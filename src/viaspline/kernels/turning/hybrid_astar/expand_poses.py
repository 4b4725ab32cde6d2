"""A search through poses for a robot with a turning circle that only drives forwards.

Hybrid A* (D. Dolgov, S. Thrun, M. Montemerlo, J. Diebel: "Path planning for autonomous vehicles in
unknown semi-structured environments", 2010) over place, heading and curvature. The curvature is on
one of five levels from one turning circle to the other, and a move keeps it or ramps it to the next
level, so that it is continuous (A. Scheuer, Th. Fraichard: "Continuous-curvature path planning for
car-like vehicles", 1997). From states without curvature turns with ramps and a line between them
are laid to the goal, which they hit exactly.

Tested through ``planning/turning/hybrid_astar/test_pose_search``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.heap import pop
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.turning.collision_cache import CollisionCache, looked_at, reach
from viaspline.kernels.turning.connect import MAX_SEGMENTS
from viaspline.kernels.turning.hybrid_astar.goal_arrival import arrive
from viaspline.kernels.turning.hybrid_astar.pose_nodes import (
    CLOSED,
    COST,
    EXPANDED,
    LENGTH,
    LEVEL,
    NO_NODE,
    NODES,
    OUTSIDE,
    PARENT,
    SCALE,
    SLOT,
    STILL,
    TRIED,
    Ahead,
    PoseSearch,
    add,
    key_of,
    scale_at,
    slot_of,
    to_come,
)
from viaspline.kernels.turning.hybrid_astar.primitives import (
    COUNT,
    LEVELS,
    PACE,
    STEP,
    WAYS,
    MotionPrimitives,
)

RUNNING, FULL, EMPTY = range(3)


@kernel
def set_off(
    cache: CollisionCache, search: PoseSearch, ahead: Ahead, rho: float, starts: Floats
) -> None:
    """Begin a search.

    Args:
        cache: Ground.
        search: Search, empty.
        ahead: Ahead.
        rho: The least radius [m].
        starts: x, y, heading and cost so far of each, (n, 4).
    """
    for k in range(search.headings.size):
        search.arrivals[k, LENGTH] = np.inf
        search.ends[k] = NO_NODE
    for k in range(starts.shape[0]):
        x, y, heading = starts[k, 0], starts[k, 1], starts[k, 2]
        scale = scale_at(cache, search, x, y, heading)
        key = key_of(search, x, y, heading, LEVELS // 2, scale)
        still = to_come(search, ahead, rho, x, y, heading)
        if key != 0 and still < np.inf:
            level = LEVELS // 2
            add(search, ahead, key, x, y, heading, level, scale, starts[k, 3], still, -1 - k)


@inner
def _is_free(
    cache: CollisionCache, moves: MotionPrimitives, row: int, x: float, y: float, c: float, s: float
) -> bool:
    """Whether the body surely gets along a move."""
    scale = row // (LEVELS * WAYS)
    half, pace = 0.5 * cache.frame[3], moves.scales[scale, PACE]
    last = int(moves.scales[scale, COUNT]) - 1
    k = 0
    while True:
        dx, dy, cosine, sine = moves.places[row, k]
        room = reach(
            cache, x + c * dx - s * dy, y + s * dx + c * dy, c * cosine - s * sine,
            s * cosine + c * sine,
        )  # fmt: skip
        if room < half:
            return False
        if k == last:
            return True
        k = min(last, k + max(1, int(min((room + half) / pace, 1e6))))


@inner
def _expand(
    cache: CollisionCache, moves: MotionPrimitives, search: PoseSearch, ahead: Ahead, node: int
) -> None:
    """Do every move from a node."""
    x, y, heading, cost, _ = search.nodes[node]
    level, scale = search.links[node, LEVEL], search.links[node, SCALE]
    c, s = math.cos(heading), math.sin(heading)
    last = int(moves.scales[scale, COUNT]) - 1
    for way in range(WAYS):
        if not 0 <= level + way - 1 < LEVELS:
            continue
        row = (scale * LEVELS + level) * WAYS + way
        dx, dy = moves.places[row, last, 0], moves.places[row, last, 1]
        to_x, to_y, to = x + c * dx - s * dy, y + s * dx + c * dy, heading + moves.turns[row]
        to_scale = scale_at(cache, search, to_x, to_y, to)
        key = key_of(search, to_x, to_y, to, level + way - 1, to_scale)
        if key == 0:
            search.counts[OUTSIDE] += 1
            continue
        other, more = search.cells[slot_of(search, key)] - 1, cost + moves.scales[scale, STEP]
        if other >= 0 and (search.links[other, CLOSED] != 0 or search.nodes[other, COST] <= more):
            continue
        still = to_come(search, ahead, moves.sizes[0], to_x, to_y, to)
        if still < np.inf and _is_free(cache, moves, row, x, y, c, s):
            add(search, ahead, key, to_x, to_y, to, level + way - 1, to_scale, more, still, node)


@inner
def _done(cache: CollisionCache, search: PoseSearch) -> int:
    """What was done so far, in what takes about the same time: see ``effort``."""
    return looked_at(cache) + search.counts[TRIED] + WAYS * search.counts[EXPANDED]


@kernel
def go_on(
    cache: CollisionCache, moves: MotionPrimitives, search: PoseSearch, ahead: Ahead, quota: int,
    effort: int,
) -> int:  # fmt: skip
    """Expand some nodes.

    Args:
        cache: Ground.
        moves: Moves.
        search: Search, written in place.
        ahead: Ahead.
        quota: How many nodes at most; it also ends with an arrival.
        effort: How many distances are reckoned, connections tried and moves done in all: it ends
            with the node in which that becomes more.

    Returns:
        RUNNING: there are more; FULL: there is no room for more; EMPTY: everything that can be
        reached has been.
    """
    segments = np.empty((MAX_SEGMENTS, 3))
    last = _done(cache, search) + effort
    for _ in range(quota):
        if search.heap.size[0] == 0:
            return EMPTY
        if _done(cache, search) >= last:
            return RUNNING
        if search.counts[NODES] + WAYS > search.nodes.shape[0]:
            return FULL
        node = pop(search.heap)
        if search.links[node, CLOSED] != 0:
            continue
        search.links[node, CLOSED] = 1
        row = search.nodes[node]
        if search.cells[search.links[node, SLOT]] - 1 != node:
            continue
        search.counts[EXPANDED] += 1
        _expand(cache, moves, search, ahead, node)
        if search.links[node, LEVEL] != LEVELS // 2:
            continue
        every = 1 + int(row[STILL] / moves.sizes[0])  # the farther, the less it is worth a try
        if search.counts[EXPANDED] % every > 1:
            continue
        if arrive(cache, moves, search, node, segments):
            return RUNNING
    return RUNNING


@kernel
def path_to(moves: MotionPrimitives, search: PoseSearch, node: int) -> tuple[Floats, int]:
    """The way to a node.

    Returns:
        Segments (n, 3), see ``cache``, and the number of the start.
    """
    size, at = 0, node
    while search.links[at, PARENT] >= 0:
        at = search.links[at, PARENT]
        size += 1
    segments = np.zeros((2 * size, 3))
    start = -1 - search.links[at, PARENT]
    at = node
    for step in range(size - 1, -1, -1):
        parent = search.links[at, PARENT]
        level = search.links[parent, LEVEL]
        scale = search.links[parent, SCALE]
        row = (scale * LEVELS + level) * WAYS + search.links[at, LEVEL] - level + 1
        for i in range(2):
            for column in range(3):
                segments[2 * step + i, column] = moves.segments[row, i, column]
        at = parent
    return segments, start
