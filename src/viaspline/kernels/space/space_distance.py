"""Signed distance of a place, and distance of a chord, to what is in a packed world in space.

"Distance" is that of the core about the place: see ``PackedSpace``. It is negative inside of a
solid and outside of the bounds, exact outside of solids, and 1-Lipschitz. Every query takes a
``limit``: what is farther away need not be looked at, and the answer is then the limit itself with
the index -1. The bounds answer with the index -2, fence f with ``-3 - f``, solids with their own
and the ground with the one after the last.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inlined, kernel
from viaspline.kernels.space.ground_columns import ground_chord, ground_signed
from viaspline.kernels.space.line_distance import line_chord, line_signed
from viaspline.kernels.space.packed_space import LINE, PRISM, PackedSpace
from viaspline.kernels.space.prism_distance import prism_chord, prism_signed
from viaspline.kernels.space.product_distance import combined, rectangle_signed
from viaspline.kernels.space.voxel_distance import cut, voxels_chord, voxels_signed
from viaspline.kernels.world.distance import inner_signed
from viaspline.kernels.world.segment import inner_segment


@inlined
def _box_signed(space: PackedSpace, node: int, x: float, y: float, z: float) -> float:
    """Signed distance between the core and the box of a node: a bound for all that is in it."""
    box = space.boxes[node]
    b = max(box[2] - z, z - box[5]) - space.core[1]
    a = rectangle_signed(x, y, box[0], box[1], box[3], box[4]) - space.core[0]
    return combined(a, b)


@inlined
def solid_signed(space: PackedSpace, i: int, x: float, y: float, z: float, limit: float) -> float:
    """Signed distance between solid i and the core at a place [m]."""
    kind, row = space.kinds[i], space.rows[i]
    if kind == PRISM:
        return prism_signed(space, row, x, y, z, limit)
    if kind == LINE:
        return line_signed(space.lines, row, x, y, z, space.core, limit)
    return voxels_signed(space, row, x, y, z, limit)


@inlined
def solid_chord(
    space: PackedSpace, i: int, ax: float, ay: float, az: float, bx: float, by: float, bz: float,
    limit: float,
) -> float:  # fmt: skip
    """Distance between solid i and the core along the chord from a to b [m]; see the module."""
    kind, row = space.kinds[i], space.rows[i]
    dx, dy, dz = bx - ax, by - ay, bz - az
    if kind == PRISM:
        return prism_chord(space, row, ax, ay, az, dx, dy, dz, limit)
    if kind == LINE:
        return line_chord(space.lines, row, ax, ay, az, dx, dy, dz, space.core, limit)
    return voxels_chord(space, row, ax, ay, az, bx, by, bz, limit)


@inlined
def _first_guess(space: PackedSpace, x: float, y: float, z: float) -> int:
    """The solid that is found by going to the nearer box on every level of the tree."""
    node = 0
    while space.leaf[node] < 0:
        left = node + 1
        right = space.skip[left]
        node = left
        if _box_signed(space, right, x, y, z) < _box_signed(space, left, x, y, z):
            node = right
    return space.leaf[node]


@inlined
def space_distance(
    space: PackedSpace, x: float, y: float, z: float, limit: float
) -> tuple[float, int]:
    """Signed distance between the world and the core at a place [m], and what is nearest.

    Returns:
        (distance [m], index): see the module; the limit and -1 where nothing is nearer than that.
    """
    radius = space.core[0]
    reach = limit + radius
    best = limit
    index = -1
    apart, side = inner_signed(space, x, y, reach)
    if side != -1:
        best = apart - radius
        index = side
    nodes = space.leaf.size
    i = _first_guess(space, x, y, z) if nodes > 16 else -1
    node = 0
    while True:
        if i >= 0:
            apart = solid_signed(space, i, x, y, z, best)
            if apart < best:
                best = apart
                index = i
            i = -1
        elif node == nodes:
            break
        elif _box_signed(space, node, x, y, z) >= best:
            node = space.skip[node]
        else:
            i = space.leaf[node]
            node += 1
    apart = ground_signed(space, x, y, z, best)
    if apart < best:
        best = apart
        index = space.kinds.size
    return best, index


@inlined
def _is_near(
    space: PackedSpace, node: int, ax: float, ay: float, az: float, dx: float, dy: float,
    dz: float, best: float,
) -> bool:  # fmt: skip
    """Whether the chord from a by d comes into the box of a node, grown by the core and so much."""
    box = space.boxes[node]
    wide, high = best + space.core[0], best + space.core[1]
    near, far = cut(0.0, 1.0, ax, dx, box[0] - wide, box[3] + wide)
    near, far = cut(near, far, ay, dy, box[1] - wide, box[4] + wide)
    near, far = cut(near, far, az, dz, box[2] - high, box[5] + high)
    return near <= far


@inlined
def space_segment(
    space: PackedSpace, x0: float, y0: float, z0: float, x1: float, y1: float, z1: float,
    limit: float,
) -> tuple[float, int]:  # fmt: skip
    """Distance between the world and the core along a chord [m], and what is nearest.

    Returns:
        (distance [m], index): never above the true one, within a nanometre or the rounding of it;
        not above 0 where the chord touches something. See ``space_distance``.
    """
    radius = space.core[0]
    best = limit
    index = -1
    apart, side = inner_segment(space, x0, y0, x1, y1, limit + radius)
    if side != -1:
        best = apart - radius
        index = side
    dx, dy, dz = x1 - x0, y1 - y0, z1 - z0
    node = 0
    while node < space.leaf.size and best > 0.0:
        if not _is_near(space, node, x0, y0, z0, dx, dy, dz, best):
            node = space.skip[node]
            continue
        i = space.leaf[node]
        node += 1
        if i >= 0:
            apart = solid_chord(space, i, x0, y0, z0, x1, y1, z1, best)
            if apart < best:
                best = apart
                index = i
    if best > 0.0:
        apart = ground_chord(space, x0, y0, z0, dx, dy, dz, best)
        if apart < best:
            best = apart
            index = space.kinds.size
    return best, index


@kernel
def space_distances(space: PackedSpace, places: Floats) -> tuple[Floats, Ints]:
    """Signed distance and index of what is nearest, for places (n, 3)."""
    count = places.shape[0]
    distance = np.empty(count)
    index = np.empty(count, np.int64)
    for k in range(count):
        distance[k], index[k] = space_distance(
            space, places[k, 0], places[k, 1], places[k, 2], math.inf
        )
    return distance, index
