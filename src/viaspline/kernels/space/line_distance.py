"""How far an upright cylinder is from a line with a radius: a ball, a cable, a mast.

Tested through ``kernels/space/test_space_distance``.
"""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import uncounted
from viaspline.kernels.space.product_distance import chord_product

SAME_DIRECTION = 1e-18  # square of the sine below which two directions are one
ROUNDING = 4e-16  # of a normal's part along its lines, for a sine of 1


@uncounted
def line_signed(
    lines: Floats, k: int, x: float, y: float, z: float, core: Floats, limit: float
) -> float:
    """Signed distance between line k and the core at a place [m].

    Where the core touches the line itself that is less the line's radius.
    """
    ax, ay, az = lines[k, 0], lines[k, 1], lines[k, 2]
    dx, dy, dz = lines[k, 3] - ax, lines[k, 4] - ay, lines[k, 5] - az
    radius = lines[k, 6]
    if core[0] == 0.0 and core[1] == 0.0:
        squared = dx * dx + dy * dy + dz * dz
        t = 0.0
        if squared > 0.0:
            t = min(1.0, max(0.0, ((x - ax) * dx + (y - ay) * dy + (z - az) * dz) / squared))
        px, py, pz = ax + t * dx - x, ay + t * dy - y, az + t * dz - z
        return min(math.sqrt(px * px + py * py + pz * pz) - radius, limit)
    reach = limit + radius
    apart = chord_product(
        ax, ay, az, dx, dy, dz, x, y, x, y, z - core[1], z + core[1], core[0], reach
    )
    return min(apart - radius, limit) if apart < reach else limit


@uncounted
def _over_the_middle(
    ux: float, uy: float, uz: float, dx: float, dy: float, dz: float, ex: float, ey: float,
    ez: float, core: Floats,
) -> tuple[float, bool]:  # fmt: skip
    """Distance of the core from the plane of all u + t d - s e [m], and is t, s in [0, 1] there.

    The plane has a point that is nearest to the core; where it has many, one of them stands for
    them all, for then either it lies between the four sides or a side has one of them as well.
    The less the directions differ, the less is known of the normal; the distance is less by that.
    """
    nx, ny, nz = dy * ez - dz * ey, dz * ex - dx * ez, dx * ey - dy * ex
    squared = nx * nx + ny * ny + nz * nz
    long = dx * dx + dy * dy + dz * dz
    lengths = long * (ex * ex + ey * ey + ez * ez)
    if squared <= SAME_DIRECTION * lengths:
        return 0.0, False
    size = math.sqrt(squared)
    nx, ny, nz = nx / size, ny / size, nz / size
    at = -(ux * dx + uy * dy + uz * dz) / long
    px, py, pz = ux + at * dx, uy + at * dy, uz + at * dz  # the same plane, and no longer than need
    offset = nx * px + ny * py + nz * pz
    doubt = ROUNDING * math.sqrt(lengths * (px * px + py * py + pz * pz)) / size
    side = 1.0 if offset >= 0.0 else -1.0
    level = math.sqrt(nx * nx + ny * ny)
    reach = core[0] * level + core[1] * abs(nz)
    share = side * core[0] / level if level > 0.0 else 0.0
    mx, my, mz = share * nx, share * ny, side * core[1] if nz > 0.0 else -side * core[1]
    if nz == 0.0:
        mz = 0.0
    apart = abs(offset) - reach - doubt
    if apart <= 0.0:
        share = abs(offset) / reach if reach > 0.0 else 0.0
        mx, my, mz = share * mx, share * my, share * mz
        apart = 0.0
    else:
        mx, my, mz = mx + side * apart * nx, my + side * apart * ny, mz + side * apart * nz
    kx, ky, kz = mx - ux, my - uy, mz - uz
    t = (ky * ez - kz * ey) * nx + (kz * ex - kx * ez) * ny + (kx * ey - ky * ex) * nz
    s = (ky * dz - kz * dy) * nx + (kz * dx - kx * dz) * ny + (kx * dy - ky * dx) * nz
    return apart, 0.0 <= t <= size and 0.0 <= s <= size


@uncounted
def line_chord(
    lines: Floats, k: int, ax: float, ay: float, az: float, dx: float, dy: float, dz: float,
    core: Floats, limit: float,
) -> float:  # fmt: skip
    """Distance between line k and the core along the chord from a by d [m].

    The differences of their places fill a parallelogram, whose distance from the core is that of
    its plane, or of one of its four sides.
    """
    lx, ly, lz = lines[k, 0], lines[k, 1], lines[k, 2]
    ex, ey, ez = lines[k, 3] - lx, lines[k, 4] - ly, lines[k, 5] - lz
    radius, half = core[0], core[1]
    reach = limit + lines[k, 6]
    if reach <= 0.0:
        return limit
    plane, inside = _over_the_middle(ax - lx, ay - ly, az - lz, dx, dy, dz, ex, ey, ez, core)
    if plane >= reach:
        return limit
    best = reach
    if inside:
        best = plane
    else:
        best = chord_product(
            ax, ay, az, dx, dy, dz, lx, ly, lx, ly, lz - half, lz + half, radius, best
        )
        if ex != 0.0 or ey != 0.0 or ez != 0.0:
            mx, my, mz = lx + ex, ly + ey, lz + ez
            best = chord_product(
                ax, ay, az, dx, dy, dz, mx, my, mx, my, mz - half, mz + half, radius, best
            )
            best = chord_product(
                lx, ly, lz, ex, ey, ez, ax, ay, ax, ay, az - half, az + half, radius, best
            )
            bx, by, bz = ax + dx, ay + dy, az + dz
            best = chord_product(
                lx, ly, lz, ex, ey, ez, bx, by, bx, by, bz - half, bz + half, radius, best
            )
    return min(best - lines[k, 6], limit) if best < reach else limit
