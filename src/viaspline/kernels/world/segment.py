"""Distance of a segment to what is in a packed world.

Segments take the second-order step of the certificate, and they are what routes are made of. The
``limit`` of a query and the indices of its answer are those of ``distance``.

Tested through ``kernels/world/test_distance``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags
from viaspline.kernels.jit import inlined, kernel, uncounted
from viaspline.kernels.world.distance import fence_signed
from viaspline.kernels.world.packed import PackedFences, PackedWorld
from viaspline.kernels.world.plane import box_gap, box_signed, segment_segment
from viaspline.kernels.world.shape import obstacle_segment


@uncounted
def fence_segment(world: PackedFences, f: int, ax: float, ay: float, bx: float, by: float) -> float:
    """Distance between the segment a-b and the outside of fence f [m]; 0 where it leaves it."""
    if fence_signed(world, f, ax, ay) <= 0.0:
        return 0.0
    best = np.inf
    for e in range(world.fence_edges[f], world.fence_edges[f + 1]):
        edge = world.fences[e]
        best = min(best, segment_segment(ax, ay, bx, by, edge[0], edge[1], edge[2], edge[3]))
    return best


@inlined
def inner_segment(
    world: PackedFences, ax: float, ay: float, bx: float, by: float, limit: float
) -> tuple[float, int]:
    """Distance of the segment a-b to what the robot stays inside of [m], and which."""
    best = limit
    index = -1
    if world.bounds.shape[0] > 0:
        distance = -max(box_signed(world.bounds, 0, ax, ay), box_signed(world.bounds, 0, bx, by))
        if distance < best:
            best = distance
            index = -2
    for f in range(world.fence_edges.size - 1):
        distance = fence_segment(world, f, ax, ay, bx, by)
        if distance < best:
            best = distance
            index = -3 - f
    return best, index


@inlined
def nearest_to_segment(
    world: PackedWorld, ax: float, ay: float, bx: float, by: float, limit: float
) -> tuple[float, int]:
    """Distance of the segment a-b to the world [m] and what is nearest (see ``nearest``)."""
    best, index = inner_segment(world, ax, ay, bx, by, limit)
    x0 = min(ax, bx)
    x1 = max(ax, bx)
    y0 = min(ay, by)
    y1 = max(ay, by)
    node = 0
    while node < world.leaf.size:
        if box_gap(world.boxes, node, x0, y0, x1, y1) >= best:
            node = world.skip[node]
            continue
        obstacle = world.leaf[node]
        if obstacle >= 0:
            distance = obstacle_segment(world, obstacle, ax, ay, bx, by, best)
            if distance < best:
                best = distance
                index = obstacle
        node += 1
    return best, index


@kernel
def segment_distance(
    world: PackedWorld, ax: float, ay: float, bx: float, by: float, limit: float
) -> tuple[float, int]:
    """What ``nearest_to_segment`` tells kernels, asked from Python."""
    return nearest_to_segment(world, ax, ay, bx, by, limit)


@kernel
def mark_near_segment(
    world: PackedWorld, ax: float, ay: float, bx: float, by: float, width: float, found: Flags
) -> int:
    """Mark every obstacle nearer than ``width`` to the segment a-b in ``found``, (n,) of bool.

    Returns:
        How many were newly marked.
    """
    x0 = min(ax, bx)
    x1 = max(ax, bx)
    y0 = min(ay, by)
    y1 = max(ay, by)
    count = 0
    node = 0
    while node < world.leaf.size:
        if box_gap(world.boxes, node, x0, y0, x1, y1) >= width:
            node = world.skip[node]
            continue
        i = world.leaf[node]
        if i >= 0 and not found[i] and obstacle_segment(world, i, ax, ay, bx, by, width) < width:
            found[i] = True
            count += 1
        node += 1
    return count
