"""How a search through poses comes to the goal, or to what another search has found.

Two turns with ramps and a line between them are laid there from a state without curvature.

Tested through ``planning/turning/hybrid_astar/test_pose_search``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.turning.collision_cache import CollisionCache, is_clear
from viaspline.kernels.turning.connect import MAX_SEGMENTS, connection
from viaspline.kernels.turning.hybrid_astar.pose_nodes import (
    FIRST,
    HERE,
    LENGTH,
    NO_NODE,
    SECOND,
    STILL,
    THERE,
    TRIED,
    PoseSearch,
    key_of,
    scale_at,
    slot_of,
)
from viaspline.kernels.turning.hybrid_astar.primitives import LEVELS, MotionPrimitives

PLACES_AHEAD = 3  # places ahead at which another search is looked for
MIN_GAIN_M = 1e-6  # an arrival has to be shorter by as much to replace another [m]


@inner
def arrive(
    cache: CollisionCache,
    moves: MotionPrimitives,
    search: PoseSearch,
    node: int,
    bound: float,
    segments: Floats,
) -> bool:
    """Try to reach the goal straight from a node; whether an arrival has become shorter."""
    rho, ramp = moves.sizes[0], moves.sizes[1]
    x, y, heading, cost, _ = search.nodes[node]
    dx, dy = search.goal[0] - x, search.goal[1] - y
    found = False
    for k in range(search.headings.size):
        goal = search.headings[k]
        best = min(search.arrivals[k, LENGTH], bound) - MIN_GAIN_M - cost
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


@inner
def meet(
    cache: CollisionCache,
    moves: MotionPrimitives,
    search: PoseSearch,
    other: PoseSearch,
    node: int,
    segments: Floats,
) -> bool:
    """Try to reach what another search, which comes the other way, has found close ahead.

    Returns:
        Whether a way between the two has become shorter.
    """
    rho, ramp = moves.sizes[0], moves.sizes[1]
    x, y, heading, cost, _ = search.nodes[node]
    found = False
    for k in range(PLACES_AHEAD):
        gap = (k + 1) * max(0.5 * rho, 4.5 * ramp)
        to_x, to_y = x + gap * math.cos(heading), y + gap * math.sin(heading)
        scale = scale_at(cache, other, to_x, to_y, heading)
        key = key_of(other, to_x, to_y, heading + math.pi, LEVELS // 2, scale)
        if key == 0:
            continue
        there = other.cells[slot_of(other, key)] - 1
        if there < 0:
            continue
        to_x, to_y, turned, rest, _ = other.nodes[there]
        dx, dy, goal = to_x - x, to_y - y, turned + math.pi
        for s1 in (1.0, -1.0):
            for s2 in (1.0, -1.0):
                search.counts[TRIED] += 1
                count, length = connection(dx, dy, heading, goal, s1, s2, rho, ramp, segments)
                whole = cost + length + rest
                if whole < search.meeting[LENGTH] - MIN_GAIN_M and is_clear(
                    cache, x, y, heading, segments, count
                ):
                    met = search.meeting
                    met[LENGTH], met[FIRST], met[SECOND] = whole, s1, s2
                    met[HERE], met[THERE] = node, there
                    found = True
    return found


@kernel
def connected(moves: MotionPrimitives, dx: float, dy: float, start: float, goal: float, s1: float,
              s2: float) -> Floats:  # fmt: skip
    """The segments of a connection, see ``connect.connection``."""
    segments = np.empty((MAX_SEGMENTS, 3))
    count, _ = connection(dx, dy, start, goal, s1, s2, moves.sizes[0], moves.sizes[1], segments)
    return segments[:count].copy()


@kernel
def bridge(
    cache: CollisionCache,
    moves: MotionPrimitives,
    there: PoseSearch,
    back: PoseSearch,
    out: Ints,
    home: Ints,
) -> tuple[float, int, int, float, float]:
    """Connect a search from the start with one that comes backwards from the goal.

    Args:
        cache: Ground.
        moves: Moves.
        there: The search from the start.
        back: The search from the goal, with all headings turned round.
        out: Nodes without curvature of the first, (n,).
        home: The same of the second, (m,).

    Returns:
        Length of the shortest way [m], infinite if there is none; the two nodes; the sides of the
        two turns between them.
    """
    segments = np.empty((MAX_SEGMENTS, 3))
    best, first, last, side1, side2 = np.inf, NO_NODE, NO_NODE, 0.0, 0.0
    for i in range(out.size):
        x, y, heading, cost, _ = there.nodes[out[i]]
        for j in range(home.size):
            to_x, to_y, turned, rest, _ = back.nodes[home[j]]
            dx, dy, goal = to_x - x, to_y - y, turned + math.pi
            if cost + rest + math.hypot(dx, dy) >= best:
                continue
            for s1 in (1.0, -1.0):
                for s2 in (1.0, -1.0):
                    count, length = connection(
                        dx, dy, heading, goal, s1, s2, moves.sizes[0], moves.sizes[1], segments
                    )
                    if cost + rest + length < best and is_clear(
                        cache, x, y, heading, segments, count
                    ):
                        best, first, last = cost + rest + length, out[i], home[j]
                        side1, side2 = s1, s2
    return best, first, last, side1, side2
