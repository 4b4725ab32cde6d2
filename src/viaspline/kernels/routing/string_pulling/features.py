"""What a taut string can lie against, near a place: discs, and the convex corners of the rest."""

from __future__ import annotations

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import uncounted
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.plane import box_signed
from viaspline.kernels.world.ring_features import edge_features
from viaspline.kernels.world.shape import obstacle_features


@uncounted
def features_near(world: PackedWorld, x: float, y: float, reach: float, out: Floats) -> int:
    """Write the features within ``reach`` of (x, y) [m] to ``out``, (size, 5).

    Returns:
        How many there are; where they are more than the room, the rest is left out.
    """
    count = 0
    node = 0
    while node < world.leaf.size:
        if box_signed(world.boxes, node, x, y) > reach:
            node = world.skip[node]
            continue
        obstacle = world.leaf[node]
        node += 1
        if obstacle >= 0:
            count = obstacle_features(world, obstacle, x, y, reach, out, count)
    for f in range(world.fence_edges.size - 1):
        first = world.fence_edges[f]
        last = world.fence_edges[f + 1]
        count = edge_features(world.fences, first, last, 0.0, x, y, reach, out, count)
    return min(count, out.shape[0])
