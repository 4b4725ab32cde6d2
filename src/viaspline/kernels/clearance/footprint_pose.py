"""A polygonal body standing in a packed world: its distance, and what lies wholly inside of it.

The body's outline is a ring of corners in the robot's frame, x forward and y left, about its
reference point. A pose is the reference point's place and the cosine and sine of the heading.

Tested through ``kernels/clearance/test_footprint_walk``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.world.distance import nearest
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.plane import box_signed, point_segment
from viaspline.kernels.world.segment import nearest_to_segment
from viaspline.kernels.world.shape import obstacle_enclosed


@inner
def outline_gap(body: Floats, x: float, y: float) -> float:
    """Distance from (x, y) in the robot's frame to the outline [m]."""
    gap = np.inf
    before = body.shape[0] - 1
    for k in range(body.shape[0]):
        other = point_segment(x, y, body[before, 0], body[before, 1], body[k, 0], body[k, 1])
        gap = min(gap, other)
        before = k
    return gap


@inner
def outer_radius(body: Floats) -> float:
    """Distance from the reference point to the farthest corner [m]."""
    squared = 0.0
    for k in range(body.shape[0]):
        squared = max(squared, body[k, 0] * body[k, 0] + body[k, 1] * body[k, 1])
    return math.sqrt(squared)


@inner
def enclosed(
    world: PackedWorld, body: Floats, outer: float, x: float, y: float, c: float, s: float
) -> tuple[int, float, float]:
    """An obstacle of which a point lies inside the body, and that point.

    One point of each connected piece is asked for; with an outline that nothing crosses the
    answer -1 proves that nothing is inside.

    Args:
        world: PackedWorld.
        body: The outline (k, 2) [m].
        outer: Its outer radius [m].
        x: Where the reference point is [m].
        y: The same.
        c: Cosine of the heading.
        s: Its sine.

    Returns:
        (index or -1, x, y [m]).
    """
    node = 0
    while node < world.leaf.size:
        if box_signed(world.boxes, node, x, y) >= outer:
            node = world.skip[node]
            continue
        i = world.leaf[node]
        node += 1
        if i < 0:
            continue
        found, px, py = obstacle_enclosed(world, i, body, outer, x, y, c, s)
        if found:
            return i, px, py
    return -1, 0.0, 0.0


@inner
def pose_distance(
    world: PackedWorld,
    body: Floats,
    outer: float,
    x: float,
    y: float,
    c: float,
    s: float,
    limit: float,
) -> tuple[float, int]:
    """Distance between the body in a pose and the world [m], and what is nearest.

    0 where it touches or overlaps something or leaves the bounds or a fence; the limit with the
    index -1 where nothing is nearer than that.
    """
    centre, index = nearest(world, x, y, limit + outer)
    if centre >= limit + outer:
        return limit, -1
    best = min(limit, max(centre, 0.0))
    index = index if centre < limit else -1
    if best == 0.0:
        return best, index
    before = body.shape[0] - 1
    for k in range(body.shape[0]):
        ax = x + c * body[before, 0] - s * body[before, 1]
        ay = y + s * body[before, 0] + c * body[before, 1]
        bx = x + c * body[k, 0] - s * body[k, 1]
        by = y + s * body[k, 0] + c * body[k, 1]
        distance, other = nearest_to_segment(world, ax, ay, bx, by, best)
        if distance < best:
            best = distance
            index = other
            if best <= 0.0:
                return 0.0, index
        before = k
    inside, _, _ = enclosed(world, body, outer, x, y, c, s)
    return (0.0, inside) if inside >= 0 else (best, index)


@kernel
def body_distances(world: PackedWorld, poses: Floats, body: Floats) -> tuple[Floats, Ints]:
    """Distance between a body and the world [m] and what is nearest, in every pose.

    Args:
        world: PackedWorld.
        poses: x, y [m], heading [rad], (n, 3).
        body: The outline (k, 2) [m]; the reference point lies inside.

    Returns:
        (distance (n,), index (n,)): see ``pose_distance``; without a limit.
    """
    outer = outer_radius(body)
    distance = np.empty(poses.shape[0])
    index = np.empty(poses.shape[0], np.int64)
    for k in range(poses.shape[0]):
        heading = poses[k, 2]
        distance[k], index[k] = pose_distance(
            world, body, outer, poses[k, 0], poses[k, 1],
            math.cos(heading), math.sin(heading), np.inf,
        )  # fmt: skip
    return distance, index
