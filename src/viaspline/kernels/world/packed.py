"""The world as kernels see it: one NamedTuple of arrays, the same argument for every kernel.

A new kind of obstacle is one more field here and one more file beside ``distance.py``; a world
without that kind has an empty array.
"""

from __future__ import annotations

from typing import NamedTuple

from viaspline.kernels.arrays import Columns, Floats, Ints


class PackedWorld(NamedTuple):
    """A static planar world.

    Obstacle ``i`` is a circle, a polygon or a grid: ``kind[i]`` is 0, 1 or 2 and ``slot[i]`` its
    place among its like. The robot stays inside the bounds and inside every fence.

    Attributes:
        kind: (n,).
        slot: (n,).
        circles: Centre and radius [m], (c, 3).
        polygon_blocks: Polygon p has blocks ``polygon_blocks[p]:polygon_blocks[p + 1]``, (p + 1,).
        block_edges: Edges of block b are ``block_edges[b]:block_edges[b + 1]``, (b + 1,).
        block_boxes: x_min, y_min, x_max, y_max [m], (b, 4).
        edges: x0, y0, x1, y1 [m]; outer rings run anticlockwise, holes clockwise, (e, 4).
        grid_frames: Of each grid x, y of its origin [m], cosine and sine of its yaw, side of a cell
            [m], (g, 5).
        grid_shapes: Of each grid its width and height in cells, and where its first cell stands in
            the two tables, (g, 3).
        to_right: Row by row, from each cell the columns to the next blocked cell to the right
            (32767: there is none); of a blocked cell, 0 less the columns to the next free one
            (-32768: there is none). (cells of all grids,) of int16.
        to_left: The same to the left.
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
    grid_frames: Floats
    grid_shapes: Ints
    to_right: Columns
    to_left: Columns
    bounds: Floats
    fence_edges: Ints
    fences: Floats
    boxes: Floats
    skip: Ints
    leaf: Ints
