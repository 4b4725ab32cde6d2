"""How far an upright cylinder is from solids and from the ground, one at a time.

Missions ask this of a few places; a planner's kernels answer it for millions.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.maps.squares import signed_distance
from viaspline.maps.terrain import Terrain
from viaspline.maps.voxels import Voxels
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import GridPrism, Prism, RoundedSegment, Solid
from viaspline.mission.space.upright_body import UprightBody

_HALVINGS = 100
_GOLDEN = (math.sqrt(5) - 1) / 2


def solid_distance(body: UprightBody, solid: Solid, reach: float) -> float:
    """How far a body is from a solid.

    Args:
        body: The body.
        solid: What it may be near to.
        reach: How far to look [m].

    Returns:
        The distance [m], negative where they overlap; infinite if it is out of reach.

    >>> mast = RoundedSegment((0, 0, 0), (0, 0, 9), 0.5)
    >>> round(solid_distance(UprightBody(4, 0, 1, 2, 1), mast, 9), 6)
    2.5
    """
    if isinstance(solid, Prism):
        return joined(_plan_distance(body, solid.ring), body.gap(solid.low, solid.high))
    if isinstance(solid, GridPrism):
        gap = body.gap(solid.low, solid.high)
        flat = signed_distance(solid.grid, (body.x, body.y), reach + body.radius)
        return joined(flat - body.radius, gap)
    if isinstance(solid, RoundedSegment):
        return _core_distance(body, solid) - solid.radius
    return _voxel_distance(body, solid, reach)


def joined(across: float, upright: float) -> float:
    """The distance of two upright things [m] that are so far apart in plan and in height.

    >>> joined(3, 4), joined(-2, 4), joined(-2, -1)
    (5.0, 4, -1)
    """
    if across > 0 and upright > 0:
        return math.hypot(across, upright)
    return max(across, upright)


def ground_distance(body: UprightBody, terrain: Terrain, *, blocked: bool, reach: float) -> float:
    """How far a body is from the columns that the ground counts as, one for each patch.

    Args:
        body: The body.
        terrain: The ground.
        blocked: Whether what isn't known of it is taken to be as high as can be.
        reach: How far to look [m].

    Returns:
        The distance [m], negative where they overlap; infinite if it is out of reach.
    """
    cell, (x, y) = terrain.cell, terrain.origin
    wide = reach + body.radius
    ny, nx = terrain.heights.shape
    i0, i1 = _window(body.x - x, wide, cell)
    j0, j1 = _window(body.y - y, wide, cell)
    i, j = np.meshgrid(np.arange(i0, i1), np.arange(j0, j1))
    inside = (i >= 0) & (j >= 0) & (i < nx - 1) & (j < ny - 1)
    tops = np.full(i.shape, np.nan)
    a, b = i[inside], j[inside]
    h = terrain.heights
    tops[inside] = np.max([h[b, a], h[b, a + 1], h[b + 1, a], h[b + 1, a + 1]], axis=0)
    tops = np.where(np.isnan(tops), np.inf if blocked else -np.inf, tops)
    across = _square_distances(body.x - (x + i * cell), body.y - (y + j * cell), cell)
    return _nearest(across - body.radius, body.low - tops, reach)


def _window(middle: float, wide: float, cell: float) -> tuple[int, int]:
    """The first and the one beyond the last of a row of cells that reach into a window."""
    return math.floor((middle - wide) / cell), math.floor((middle + wide) / cell) + 1


def _square_distances(dx: Any, dy: Any, side: float) -> Floats:
    """How far places are from squares, of which the lower left corners are so far away [m]."""
    outside: Floats = np.hypot(
        np.maximum(np.maximum(-dx, dx - side), 0.0), np.maximum(np.maximum(-dy, dy - side), 0.0)
    )
    inside = np.minimum(np.minimum(dx, side - dx), np.minimum(dy, side - dy))
    return np.where(inside > 0, -inside, outside)


def _nearest(across: Floats, upright: Floats, reach: float) -> float:
    """The least distance of upright things; infinite if it is out of reach."""
    apart = np.where(
        (across > 0) & (upright > 0), np.hypot(across, upright), np.maximum(across, upright)
    )
    least = float(apart.min(initial=math.inf))
    return least if least <= reach else math.inf


def _plan_distance(body: UprightBody, ring: RoundedRing) -> float:
    """The signed distance in plan [m]."""
    import shapely

    core, place = ring.core(), shapely.Point(body.x, body.y)
    far: float = core.distance(place)
    if far == 0.0 and core.geom_type == "Polygon":
        far = -core.boundary.distance(place)
    return far - ring.radius - body.radius


def _core_distance(body: UprightBody, solid: RoundedSegment) -> float:
    """The distance of a line from the body [m]; it is convex along the line."""
    first, last = np.array(solid.first), np.array(solid.last)

    def far(t: float) -> float:
        x, y, z = first + t * (last - first)
        across = max(math.hypot(x - body.x, y - body.y) - body.radius, 0.0)
        return math.hypot(across, max(body.gap(z, z), 0.0))

    low, high = 0.0, 1.0
    for _ in range(_HALVINGS if solid.first != solid.last else 0):
        a, b = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
        if far(a) <= far(b):
            high = b
        else:
            low = a
    return min(far(0.5 * (low + high)), far(0.0), far(1.0))


def _voxel_distance(body: UprightBody, voxels: Voxels, reach: float) -> float:
    cell, origin, shape = voxels.cell, voxels.origin, voxels.blocked.shape
    wide = reach + body.radius
    spans = [
        _window(body.x - origin[0], wide, cell),
        _window(body.y - origin[1], wide, cell),
        (
            math.floor((body.low - reach - origin[2]) / cell),
            math.floor((body.high + reach - origin[2]) / cell) + 1,
        ),
    ]
    cut = [(max(a, 0), min(b, most)) for (a, b), most in zip(spans, shape, strict=True)]
    if any(a >= b for a, b in cut):
        return math.inf
    near = voxels.blocked[tuple(slice(a, b) for a, b in cut)]
    i, j, k = (index + a for index, (a, _) in zip(np.nonzero(near), cut, strict=True))
    dx, dy = body.x - (origin[0] + i * cell), body.y - (origin[1] + j * cell)
    floor = origin[2] + k * cell
    upright = np.maximum(floor - body.high, body.low - (floor + cell))
    return _nearest(_square_distances(dx, dy, cell) - body.radius, upright, reach)
