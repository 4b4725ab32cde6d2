"""The world in space as kernels see it: one NamedTuple of arrays, as ``PackedWorld`` is.

All solids but lines are products of a planar set and an interval of heights, so their distance
from an upright cylinder is exact. The cylinder about the place that is asked for, the *core*, is
part of the world; a ball about a place has none (0 and 0), its radius is asked for as a distance.

Tested through ``kernels/space/test_space_distance``.
"""

from __future__ import annotations

from typing import Final, NamedTuple

from viaspline.kernels.arrays import Floats, Ints

PRISM: Final = 0
LINE: Final = 1
VOXELS: Final = 2


class PackedSpace(NamedTuple):
    """A static world in space.

    The robot stays inside of the bounds and of every fence, at all heights.

    Attributes:
        kinds: Of solid i ``PRISM``, ``LINE`` or ``VOXELS``, (n,).
        rows: Of solid i its row among those of its kind, (n,).
        heads: Of ring r x, y of its first vertex, the radius by which its core is grown [m], and
            how many edges it has, (r, 4).
        ring_heights: Of each ring the height of its floor and of its roof [m], (r, 2).
        ring_blocks: Ring r has the blocks ``ring_blocks[r]:ring_blocks[r + 1]``.
        block_edges: Edges of block b are ``block_edges[b]:block_edges[b + 1]``.
        block_boxes: x_min, y_min, x_max, y_max [m], (b, 4).
        edges: x0, y0, x1, y1 [m], (e, 4).
        lines: Of each line with a radius x, y, z of its first and its last place and the radius
            [m], (k, 7).
        voxel_frames: Of each block of voxels x, y, z of its origin [m], cosine and sine of its yaw,
            side of a cube [m]; for a grid of squares over one interval of heights, a single layer
            of cubes, that interval [cubes], else nan, (g, 8).
        voxel_levels: Its levels ``voxel_starts[g]:voxel_starts[g + 1]``, from fine to coarse: words
            along x, y and z, and where its words begin, (l, 4).
        voxel_starts: Where the levels of each begin, (g + 1,).
        voxel_words: 4 x 4 x 4 bits each, bit x + 4 y + 16 z: blocked cubes on the finest level, on
            each coarser one words of the level below that aren't 0, (w,).
        heights: Of the ground's nodes [m], NaN where unknown, (ny, nx), read-only; (0, 0) without.
        ground_frame: x, y of node (0, 0) and the distance of nodes [m]; the height of flat ground,
            which is -inf where there is none; the height of ground that isn't known: inf if it
            blocks, else -inf, (5,).
        ground_levels: Of each level of the ground's pyramid, 4 x 4 of the one below: columns, rows,
            and where it begins, (l, 3).
        ground_tops: The highest corner below each of its cells [m], (c,).
        ground_planes: Of each of its cells a plane that the ground keeps close to, by its height at
            the cell's first corner [m] and its slopes along x and y, and how far the ground gets
            below and above it [m], (c, 5); inf and -inf where none of it is known.
        height_limits: Least and greatest height, least and greatest height above ground, of the
            place [m], (4,).
        core: Radius and half height of the cylinder about a place [m], (2,).
        bounds: x_min, y_min, x_max, y_max [m], (1, 4), or (0, 4) where there are none.
        fence_edges: Edges of fence f are ``fence_edges[f]:fence_edges[f + 1]`` of ``fences``.
        fences: x0, y0, x1, y1 [m], clockwise, (f, 4).
        boxes: Boxes of the tree's nodes in depth-first order, x, y, z low and high [m], (t, 6).
        skip: The node that comes after a node and all below it, (t,).
        leaf: The solid in a leaf, -1 in an inner node, (t,).
    """

    kinds: Ints
    rows: Ints
    heads: Floats
    ring_heights: Floats
    ring_blocks: Ints
    block_edges: Ints
    block_boxes: Floats
    edges: Floats
    lines: Floats
    voxel_frames: Floats
    voxel_levels: Ints
    voxel_starts: Ints
    voxel_words: Ints
    heights: Floats
    ground_frame: Floats
    ground_levels: Ints
    ground_tops: Floats
    ground_planes: Floats
    height_limits: Floats
    core: Floats
    bounds: Floats
    fence_edges: Ints
    fences: Floats
    boxes: Floats
    skip: Ints
    leaf: Ints
