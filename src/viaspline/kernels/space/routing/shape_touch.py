"""The planes between a straight way and a solid next to it: see ``route_protocol.touched``.

A solid is taken in convex parts: an edge of a prism, from its floor to its roof; a roof or floor; a
cable; a cube. Along a straight way the distance of a convex part is convex, so a search by sections
finds where it is least, and the plane stands across the shortest line there.

Tested through ``kernels/space/routing/test_shape_moves``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined, inner
from viaspline.kernels.space.line_distance import line_signed
from viaspline.kernels.space.routing.planes import add_plane
from viaspline.kernels.space.voxel_distance import cut

_SECTIONS = 44
_GOLDEN = 0.6180339887498949
_STEP = 1e-5  # of a difference, for a gradient [m]


@inlined
def _outside(e: float, low: float, high: float) -> float:
    """How far a coordinate lies outside of an interval, with its sign."""
    if e < low:
        return e - low
    return e - high if e > high else 0.0


@inlined
def _product_gap(
    x: float, y: float, z: float, long: float, deep: float, low: float, high: float, grown: float
) -> float:
    """Distance from a rectangle, grown in plan, times an interval; 0 inside."""
    across = math.hypot(_outside(x, 0.0, long), _outside(y, 0.0, deep)) - grown
    return math.hypot(max(across, 0.0), _outside(z, low, high))


@inner
def touch_product(
    ax: float, ay: float, az: float, dx: float, dy: float, dz: float, frame: Floats, near: float,
    radius: float, planes: Floats, count: int,
) -> int:  # fmt: skip
    """Add the plane between a way and a rectangle, grown in plan, times an interval of heights.

    Args:
        ax: Where the way begins [m].
        ay: Where it begins [m].
        az: Where it begins [m].
        dx: Where it goes [m].
        dy: Where it goes [m].
        dz: Where it goes [m].
        frame: x, y of the rectangle's first corner, cosine and sine of the direction of its first
            side, lengths of its first and second side, least and greatest height, and by how much
            it is grown in plan [m], (9,).
        near: Only what is nearer than this is of interest [m].
        radius: What the way keeps [m].
        planes: See ``route_protocol``, (n, 5).
        count: How many there are.

    Returns:
        How many there are then.
    """
    c, s = frame[2], frame[3]
    x = c * (ax - frame[0]) + s * (ay - frame[1])
    y = c * (ay - frame[1]) - s * (ax - frame[0])
    u = c * dx + s * dy
    v = c * dy - s * dx
    long, deep, low, high, grown = frame[4], frame[5], frame[6], frame[7], frame[8]
    reach = near + grown
    first, last = cut(0.0, 1.0, x, u, -reach, long + reach)
    first, last = cut(first, last, y, v, -reach, deep + reach)
    first, last = cut(first, last, az, dz, low - near, high + near)
    if last < first:
        return count
    for _ in range(_SECTIONS):
        p = last - _GOLDEN * (last - first)
        q = first + _GOLDEN * (last - first)
        at_p = _product_gap(x + p * u, y + p * v, az + p * dz, long, deep, low, high, grown)
        at_q = _product_gap(x + q * u, y + q * v, az + q * dz, long, deep, low, high, grown)
        if at_p <= at_q:
            last = q
        else:
            first = p
    t = 0.5 * (first + last)
    if t < 1e-7:
        t = 0.0
    elif t > 1.0 - 1e-7:
        t = 1.0
    px = _outside(x + t * u, 0.0, long)
    py = _outside(y + t * v, 0.0, deep)
    pz = _outside(az + t * dz, low, high)
    rho = math.hypot(px, py)
    across = max(rho - grown, 0.0)
    gap = math.hypot(across, pz)
    if gap >= near or gap == 0.0:
        return count
    share = across / (rho * gap) if across > 0.0 else 0.0
    nx = share * (c * px - s * py)
    ny = share * (s * px + c * py)
    nz = pz / gap
    offset = nx * (ax + t * dx) + ny * (ay + t * dy) + nz * (az + t * dz) - gap
    return add_plane(planes, count, nx, ny, nz, offset + radius, t)


@inner
def touch_line(
    lines: Floats, core: Floats, k: int, ax: float, ay: float, az: float, dx: float, dy: float,
    dz: float, near: float, radius: float, planes: Floats, count: int,
) -> int:  # fmt: skip
    """Add the plane between a way and line k with its radius."""
    first = 0.0
    last = 1.0
    for _ in range(_SECTIONS):
        p = last - _GOLDEN * (last - first)
        q = first + _GOLDEN * (last - first)
        at_p = line_signed(lines, k, ax + p * dx, ay + p * dy, az + p * dz, core, np.inf)
        at_q = line_signed(lines, k, ax + q * dx, ay + q * dy, az + q * dz, core, np.inf)
        if at_p <= at_q:
            last = q
        else:
            first = p
    t = 0.5 * (first + last)
    x = ax + t * dx
    y = ay + t * dy
    z = az + t * dz
    gap = line_signed(lines, k, x, y, z, core, np.inf)
    if gap >= near:
        return count
    e = _STEP
    nx = line_signed(lines, k, x + e, y, z, core, np.inf)
    nx -= line_signed(lines, k, x - e, y, z, core, np.inf)
    ny = line_signed(lines, k, x, y + e, z, core, np.inf)
    ny -= line_signed(lines, k, x, y - e, z, core, np.inf)
    nz = line_signed(lines, k, x, y, z + e, core, np.inf)
    nz -= line_signed(lines, k, x, y, z - e, core, np.inf)
    size = math.sqrt(nx * nx + ny * ny + nz * nz)
    if size == 0.0:
        return count
    nx /= size
    ny /= size
    nz /= size
    offset = nx * x + ny * y + nz * z - gap
    return add_plane(planes, count, nx, ny, nz, offset + radius, t)
