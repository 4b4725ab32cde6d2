"""The planar world as kernels see it: one NamedTuple of arrays, the same argument for every kernel.

An obstacle is a *rounded ring* or a *grid*. A rounded ring is a core of closed rings of edges, and
a radius by which the core is grown: a disc is one vertex with a radius, a capsule two, a polygon
many with radius 0 and its holes after it. What is asked of an obstacle is asked in ``shape``; which
of the two it is, is known there and nowhere else.

Tested through ``kernels/world/test_distance``.
"""

from __future__ import annotations

from typing import NamedTuple, Protocol

from viaspline.kernels.arrays import Columns, Floats, Ints


class PackedWorld(NamedTuple):
    """A static planar world.

    The robot stays inside the bounds and inside every fence.

    Attributes:
        slot: Of obstacle i its rounded ring, or -1 - g for grid g, (n,).
        heads: Of each ring x, y of its first vertex, the radius by which its core is grown [m], and
            how many edges it has: all that a disc is, in one row, (r, 4).
        ring_edges: Ring r has the edges ``ring_edges[r]:ring_edges[r + 1]``, (r + 1,).
        ring_blocks: It has the blocks ``ring_blocks[r]:ring_blocks[r + 1]``, (r + 1,).
        block_edges: Edges of block b are ``block_edges[b]:block_edges[b + 1]``, (b + 1,).
        block_boxes: x_min, y_min, x_max, y_max [m], (b, 4).
        edges: x0, y0, x1, y1 [m]; outer rings run anticlockwise, holes clockwise; a disc has one
            that ends where it begins, (e, 4).
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

    slot: Ints
    heads: Floats
    ring_edges: Ints
    ring_blocks: Ints
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


class PackedRings(Protocol):
    """The rounded rings of a packed world, in the plane or in space; see ``PackedWorld``."""

    @property
    def heads(self) -> Floats: ...  # noqa: D102

    @property
    def ring_blocks(self) -> Ints: ...  # noqa: D102

    @property
    def block_edges(self) -> Ints: ...  # noqa: D102

    @property
    def block_boxes(self) -> Floats: ...  # noqa: D102

    @property
    def edges(self) -> Floats: ...  # noqa: D102


class PackedFences(Protocol):
    """What a robot stays inside of, in the plane or in space; see ``PackedWorld``."""

    @property
    def bounds(self) -> Floats: ...  # noqa: D102

    @property
    def fence_edges(self) -> Ints: ...  # noqa: D102

    @property
    def fences(self) -> Floats: ...  # noqa: D102
