"""Signed distance of a point, and distance of a segment, to what is in a packed world.

The signed distance is negative inside an obstacle and outside the bounds or a fence; it is
1-Lipschitz. Every query takes a ``limit``: what is farther away than that need not be looked at,
and the answer is then the limit itself with the index -1. The bounds answer with the index -2,
fence f with ``-3 - f``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inlined, kernel, uncounted
from viaspline.kernels.world.packed import PackedFences, PackedWorld
from viaspline.kernels.world.plane import box_signed, squared_point_segment
from viaspline.kernels.world.ring_distance import crosses_eastwards
from viaspline.kernels.world.shape import obstacle_signed


@uncounted
def fence_signed(world: PackedFences, f: int, x: float, y: float) -> float:
    """Signed distance from (x, y) to the outside of fence f [m]; positive inside the fence."""
    inside = False
    squared = np.inf
    for e in range(world.fence_edges[f], world.fence_edges[f + 1]):
        edge = world.fences[e]
        squared = min(squared, squared_point_segment(x, y, edge[0], edge[1], edge[2], edge[3]))
        if crosses_eastwards(world.fences, e, x, y):
            inside = not inside
    return math.sqrt(squared) if inside else -math.sqrt(squared)


@inlined
def inner_signed(world: PackedFences, x: float, y: float, limit: float) -> tuple[float, int]:
    """Distance from (x, y) to what the robot stays inside of [m], and which (see ``nearest``)."""
    best = limit
    index = -1
    if world.bounds.shape[0] > 0:
        distance = -box_signed(world.bounds, 0, x, y)
        if distance < best:
            best = distance
            index = -2
    for f in range(world.fence_edges.size - 1):
        distance = fence_signed(world, f, x, y)
        if distance < best:
            best = distance
            index = -3 - f
    return best, index


@inlined
def _descend(world: PackedWorld, x: float, y: float) -> int:
    """The obstacle that is found by going to the nearest box on every level of the tree."""
    node = 0
    while world.leaf[node] < 0:
        end = world.skip[node]
        child = node + 1
        closest = child
        gap = np.inf
        while child < end:
            other = box_signed(world.boxes, child, x, y)
            if other < gap:
                gap = other
                closest = child
            child = world.skip[child]
        node = closest
    return world.leaf[node]


@inlined
def nearest(world: PackedWorld, x: float, y: float, limit: float) -> tuple[float, int]:
    """Signed distance from (x, y) to the world, and what is nearest.

    The tree's nodes stand in depth-first order, so that a walk needs no stack: to the next node,
    or past all that lies below.

    Returns:
        (distance [m], index): the obstacle's index, -2 for the bounds, -3 - f for fence f, or -1
        with the limit.
    """
    best, index = inner_signed(world, x, y, limit)
    nodes = world.leaf.size
    obstacle = _descend(world, x, y) if nodes > 64 else -1
    node = 0
    while True:
        if obstacle >= 0:
            distance = obstacle_signed(world, obstacle, x, y, best)
            if distance < best:
                best = distance
                index = obstacle
            obstacle = -1
        elif node == nodes:
            return best, index
        elif box_signed(world.boxes, node, x, y) >= best:
            node = world.skip[node]
        else:
            obstacle = world.leaf[node]
            node += 1


@kernel
def distances(world: PackedWorld, points: Floats) -> tuple[Floats, Ints]:
    """Signed distance and index of what is nearest, for points (n, 2)."""
    count = points.shape[0]
    distance = np.empty(count)
    index = np.empty(count, np.int64)
    for k in range(count):
        distance[k], index[k] = nearest(world, points[k, 0], points[k, 1], np.inf)
    return distance, index


@kernel
def obstacle_distances(world: PackedWorld, i: int, points: Floats) -> Floats:
    """Signed distance of points (n, 2) to obstacle i."""
    distance = np.empty(points.shape[0])
    for k in range(points.shape[0]):
        distance[k] = obstacle_signed(world, i, points[k, 0], points[k, 1], np.inf)
    return distance
