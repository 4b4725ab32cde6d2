"""What a packed space answers to a search for a route: see ``route_protocol``.

Limits of height above ground are looked at on lattice places, vertices, and along a way over every
line of nodes of the ground and between; what is exact is the proof of the path that is laid.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner
from viaspline.kernels.space.ground_pyramid import has_terrain
from viaspline.kernels.space.height_limits import heights_allowed
from viaspline.kernels.space.packed_space import PackedSpace
from viaspline.kernels.space.routing.planes import add_plane
from viaspline.kernels.space.routing.route_protocol import (
    PlaceLattice,
    answers_route,
    could_hold,
    is_free,
    is_open,
    neighbours,
    open_moves,
    touched,
)
from viaspline.kernels.space.routing.solid_touch import (
    is_by_box,
    touch_bounds,
    touch_ground,
    touch_solid,
)
from viaspline.kernels.space.space_distance import space_distance, space_segment

_MOST_LOOKS = 4096


@inner
def _height_is_allowed(space: PackedSpace, x: float, y: float, z: float) -> bool:
    low, high = heights_allowed(space, x, y)
    return low <= z <= high


@inner
def _heights_are_allowed(
    space: PackedSpace, x: float, y: float, z: float, dx: float, dy: float, dz: float
) -> bool:
    """Whether a way keeps the limits of height: at its ends, and over terrain between."""
    if not _height_is_allowed(space, x, y, z):
        return False
    if not _height_is_allowed(space, x + dx, y + dy, z + dz):
        return False
    limits = space.height_limits
    if not has_terrain(space) or (limits[2] == -np.inf and limits[3] == np.inf):
        return True
    looks = math.ceil(2.0 * math.hypot(dx, dy) / space.ground_frame[2])
    looks = min(looks, _MOST_LOOKS)
    for look in range(1, looks):
        t = look / looks
        if not _height_is_allowed(space, x + t * dx, y + t * dy, z + t * dz):
            return False
    return _edges_are_allowed(space, x, y, z, dx, dy, dz)


@inner
def _edges_are_allowed(
    space: PackedSpace, x: float, y: float, z: float, dx: float, dy: float, dz: float
) -> bool:
    """Whether a way keeps the limits over lines of nodes: ground bends there, by cliffs as well."""
    step = space.ground_frame[2]
    for axis in range(2):
        way = (dx if axis == 0 else dy) / step
        if way == 0.0:
            continue
        first = ((x if axis == 0 else y) - space.ground_frame[axis]) / step
        row = math.ceil(min(first, first + way))
        end = min(math.floor(max(first, first + way)), row + _MOST_LOOKS)
        while row <= end:
            t = min(max((row - first) / way, 0.0), 1.0)
            if not _height_is_allowed(space, x + t * dx, y + t * dy, z + t * dz):
                return False
            row += 1
    return True


@answers_route(is_free, PackedSpace)
def _is_free(
    space: PackedSpace, x: float, y: float, z: float, dx: float, dy: float, dz: float,
    radius: float,
) -> bool:  # fmt: skip
    if not _heights_are_allowed(space, x, y, z, dx, dy, dz):
        return False
    distance, _ = space_segment(space, x, y, z, x + dx, y + dy, z + dz, radius)
    return distance >= radius and distance > 0.0


@answers_route(is_open, PackedSpace)
def _is_open(space: PackedSpace, x: float, y: float, z: float, radius: float) -> bool:
    if not _height_is_allowed(space, x, y, z):
        return False
    return space_distance(space, x, y, z, radius)[0] >= radius


@answers_route(open_moves, PackedSpace)
def _open_moves(
    space: PackedSpace, lattice: PlaceLattice, i: int, j: int, k: int, radius: float
) -> int:
    return neighbours(lattice, i, j, k)


@answers_route(could_hold, PackedSpace)
def _could_hold(
    space: PackedSpace, lattice: PlaceLattice, i: int, j: int, k: int, radius: float
) -> bool:
    # Only the part of a cell that is within all limits can hold a free place: what of it lies
    # beyond the bounds would lead round whatever reaches up to them.
    half = 0.5 * lattice.frame[3] * (1.0 + 1e-9)
    low = np.empty(3)
    high = np.empty(3)
    for axis, row in enumerate((i, j, k)):
        middle = lattice.frame[axis] + row * lattice.frame[3]
        low[axis] = middle - half
        high[axis] = middle + half
    low[2] = max(low[2], space.height_limits[0])
    high[2] = min(high[2], space.height_limits[1])
    kept = radius + space.core[0]
    for row in range(space.bounds.shape[0]):
        for axis in range(2):
            low[axis] = max(low[axis], space.bounds[row, axis] + kept)
            high[axis] = min(high[axis], space.bounds[row, axis + 2] - kept)
    around = 0.0
    for axis in range(3):
        if low[axis] > high[axis]:
            return False
        around += (high[axis] - low[axis]) ** 2
    needed = radius - 0.5 * math.sqrt(around) * (1.0 + 1e-9)
    x = 0.5 * (low[0] + high[0])
    y = 0.5 * (low[1] + high[1])
    return space_distance(space, x, y, 0.5 * (low[2] + high[2]), needed)[0] >= needed


@answers_route(touched, PackedSpace)
def _touched(
    space: PackedSpace, x: float, y: float, z: float, dx: float, dy: float, dz: float,
    radius: float, reach: float, planes: Floats, count: int,
) -> int:  # fmt: skip
    near = radius + reach
    frame = np.empty(9)
    for end in range(2):
        low, high = heights_allowed(space, x + end * dx, y + end * dy)
        count = add_plane(planes, count, 0.0, 0.0, 1.0, low, float(end))
        count = add_plane(planes, count, 0.0, 0.0, -1.0, -high, float(end))
    count = touch_bounds(space, x, y, z, dx, dy, dz, near, radius, planes, count, frame)
    count = touch_ground(space, x, y, z, dx, dy, dz, near, radius, planes, count, frame)
    node = 0
    while node < space.leaf.size:
        if not is_by_box(space, node, x, y, z, dx, dy, dz, near):
            node = space.skip[node]
            continue
        i = space.leaf[node]
        node += 1
        if i >= 0:
            count = touch_solid(space, i, x, y, z, dx, dy, dz, near, radius, planes, count, frame)
    return count
