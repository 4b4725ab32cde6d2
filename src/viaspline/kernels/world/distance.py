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
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.world.grid_rows import grid_signed
from viaspline.kernels.world.packed import PackedWorld


@inner
def squared_point_segment(x: float, y: float, ax: float, ay: float, bx: float, by: float) -> float:
    """Squared distance from (x, y) to the segment a-b [m²]."""
    dx = bx - ax
    dy = by - ay
    squared = dx * dx + dy * dy
    w = 0.0
    if squared > 0.0:
        w = ((x - ax) * dx + (y - ay) * dy) / squared
        w = min(1.0, max(0.0, w))
    across = x - ax - w * dx
    along = y - ay - w * dy
    return across * across + along * along


@inner
def point_segment(x: float, y: float, ax: float, ay: float, bx: float, by: float) -> float:
    """Distance from (x, y) to the segment a-b [m]."""
    return math.sqrt(squared_point_segment(x, y, ax, ay, bx, by))


@inner
def box_signed(boxes: Floats, b: int, x: float, y: float) -> float:
    """Signed distance from (x, y) to box b: a lower bound for all that lies in the box."""
    left = max(boxes[b, 0] - x, x - boxes[b, 2])
    down = max(boxes[b, 1] - y, y - boxes[b, 3])
    if left <= 0.0 or down <= 0.0:
        return max(left, down)
    return math.sqrt(left * left + down * down)


@inner
def _crosses(edges: Floats, e: int, x: float, y: float) -> bool:
    """Whether the ray from (x, y) to the east crosses edge e."""
    y0 = edges[e, 1]
    y1 = edges[e, 3]
    if (y0 > y) == (y1 > y):
        return False
    return x < edges[e, 0] + (y - y0) / (y1 - y0) * (edges[e, 2] - edges[e, 0])


@inner
def polygon_signed(world: PackedWorld, p: int, x: float, y: float, limit: float) -> float:
    """Signed distance from (x, y) to polygon p [m]; negative inside."""
    boxes = world.block_boxes
    inside = False
    best = np.inf
    squared = np.inf
    for b in range(world.polygon_blocks[p], world.polygon_blocks[p + 1]):
        near = box_signed(boxes, b, x, y) < best
        ray = boxes[b, 1] <= y <= boxes[b, 3] and x <= boxes[b, 2]
        if not (near or ray):
            continue
        for e in range(world.block_edges[b], world.block_edges[b + 1]):
            edge = world.edges[e]
            if near:
                other = squared_point_segment(x, y, edge[0], edge[1], edge[2], edge[3])
                squared = min(squared, other)
            if ray and _crosses(world.edges, e, x, y):
                inside = not inside
        best = math.sqrt(squared)
    return -best if inside else min(best, limit)


@inner
def fence_signed(world: PackedWorld, f: int, x: float, y: float) -> float:
    """Signed distance from (x, y) to the outside of fence f [m]; positive inside the fence."""
    inside = False
    squared = np.inf
    for e in range(world.fence_edges[f], world.fence_edges[f + 1]):
        edge = world.fences[e]
        squared = min(squared, squared_point_segment(x, y, edge[0], edge[1], edge[2], edge[3]))
        if _crosses(world.fences, e, x, y):
            inside = not inside
    return math.sqrt(squared) if inside else -math.sqrt(squared)


@inner
def inner_signed(world: PackedWorld, x: float, y: float, limit: float) -> tuple[float, int]:
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


@inner
def obstacle_signed(world: PackedWorld, i: int, x: float, y: float, limit: float) -> float:
    """Signed distance from (x, y) to obstacle i [m]."""
    slot = world.slot[i]
    if world.kind[i] == 0:
        circle = world.circles[slot]
        dx = x - circle[0]
        dy = y - circle[1]
        return math.sqrt(dx * dx + dy * dy) - circle[2]
    if world.kind[i] == 2:
        return grid_signed(world, slot, x, y, limit)
    return polygon_signed(world, slot, x, y, limit)


@inner
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


@inner
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
