"""The world as kernels see it: one NamedTuple of arrays, the same argument for every kernel.

A new kind of obstacle is one more field here and one more file beside ``distance.py``; a world
without that kind has an empty array.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Flags = NDArray[np.bool_]


class PackedWorld(NamedTuple):
    """A static planar world.

    Obstacle ``i`` is a circle or a polygon: ``kind[i]`` is 0 or 1 and ``slot[i]`` its place among
    its like. The robot stays inside the bounds and inside every fence.

    Attributes:
        kind: (n,).
        slot: (n,).
        circles: Centre and radius [m], (c, 3).
        polygon_blocks: Polygon p has blocks ``polygon_blocks[p]:polygon_blocks[p + 1]``, (p + 1,).
        block_edges: Edges of block b are ``block_edges[b]:block_edges[b + 1]``, (b + 1,).
        block_boxes: x_min, y_min, x_max, y_max [m], (b, 4).
        edges: x0, y0, x1, y1 [m]; outer rings run anticlockwise, holes clockwise, (e, 4).
        bounds: x_min, y_min, x_max, y_max [m], (1, 4), or (0, 4) where there are none.
        fence_edges: Edges of fence f are ``fence_edges[f]:fence_edges[f + 1]`` of ``fences``.
        fences: x0, y0, x1, y1 [m]; the rings run clockwise: as everywhere, free space lies to the
            right of an edge, (g, 4).
        boxes: Boxes of the tree's nodes in depth-first order [m], (t, 4).
        skip: The node that comes after a node and all below it, (t,).
        leaf: The obstacle in a leaf, -1 in an inner node, (t,).
    """

    kind: Ints
    slot: Ints
    circles: Floats
    polygon_blocks: Ints
    block_edges: Ints
    block_boxes: Floats
    edges: Floats
    bounds: Floats
    fence_edges: Ints
    fences: Floats
    boxes: Floats
    skip: Ints
    leaf: Ints
