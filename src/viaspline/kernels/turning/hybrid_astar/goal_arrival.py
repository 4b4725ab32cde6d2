"""How a search through poses comes to the goal.

Two turns with ramps and a line between them are laid there from a state without curvature.

Tested through ``planning/turning/hybrid_astar/test_pose_search``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.turning.collision_cache import CollisionCache, is_clear
from viaspline.kernels.turning.connect import MAX_SEGMENTS, connection
from viaspline.kernels.turning.hybrid_astar.pose_nodes import (
    FIRST,
    LENGTH,
    SECOND,
    STILL,
    TRIED,
    PoseSearch,
)
from viaspline.kernels.turning.hybrid_astar.primitives import MotionPrimitives

MIN_GAIN_M = 1e-6  # an arrival has to be shorter by as much to replace another [m]


@inner
def arrive(
    cache: CollisionCache, moves: MotionPrimitives, search: PoseSearch, node: int, segments: Floats
) -> bool:
    """Try to reach the goal straight from a node; whether an arrival has become shorter."""
    rho, ramp = moves.sizes[0], moves.sizes[1]
    x, y, heading, cost, _ = search.nodes[node]
    dx, dy = search.goal[0] - x, search.goal[1] - y
    found = False
    for k in range(search.headings.size):
        goal = search.headings[k]
        best = search.arrivals[k, LENGTH] - MIN_GAIN_M - cost
        if best <= search.nodes[node, STILL]:
            continue
        for s1 in (1.0, -1.0):
            for s2 in (1.0, -1.0):
                if math.isnan(goal) and s2 < 0.0:
                    continue
                search.counts[TRIED] += 1
                count, length = connection(dx, dy, heading, goal, s1, s2, rho, ramp, segments)
                if length < best and is_clear(cache, x, y, heading, segments, count):
                    best = length
                    arrival = search.arrivals[k]
                    arrival[LENGTH], arrival[FIRST], arrival[SECOND] = cost + length, s1, s2
                    search.ends[k] = node
                    found = True
    return found


@kernel
def connected(moves: MotionPrimitives, dx: float, dy: float, start: float, goal: float, s1: float,
              s2: float) -> Floats:  # fmt: skip
    """The segments of a connection, see ``connect.connection``."""
    segments = np.empty((MAX_SEGMENTS, 3))
    count, _ = connection(dx, dy, start, goal, s1, s2, moves.sizes[0], moves.sizes[1], segments)
    return segments[:count].copy()
