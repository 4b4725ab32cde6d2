"""The shape of a step aside: half of a cubic B-spline's basis function, or a swing.

Where there is room a half begins without an offset, a slope or a bend. Where a via point is too
near for that, the path swings through it: it runs through the via point in another direction, and
swings out a little on its far side.

Tested through ``fleet/laying/test_step_aside``.
"""

from __future__ import annotations

import math

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.marked_joints import FIXED, walk_path
from viaspline.kernels.jit import inlined, inner

TOUCH_M = 1e-4
"""By which a step aside is too wide, so that the next look finds it wide enough."""
LEAST_KEPT = 0.2
"""A path bends no more sharply than that its inner side is shortened to this."""
SHORTEST = 0.6
"""The shortest half of a step aside, of the one that bends no more than the disc,"""
SHORTEST_SWING = 0.3
"""and that of one that swings through a via point."""
GENTLE = 0.7
"""Of the half that is wanted, from which on a path doesn't swing through a via point for more."""
STEEPEST = 1.8
"""The greatest slope with which a path swings through a via point, to the path as it was."""


@inlined
def share_aside(x: float, half: float, beyond: float) -> tuple[float, float]:
    """How far aside a path is, as a share of the most, and its slope away from there [1/m].

    Args:
        x: How far from the place that is farthest aside [m], at least 0.
        half: How long this half is, to the via point if it swings through that [m].
        beyond: How far it swings out behind that [m]; negative if it doesn't swing at all.
    """
    t = x / half
    if beyond >= 0.0:
        if t < 1.0:
            return 1.0 - 1.5 * t * t + 0.5 * t * t * t, (-3.0 * t + 1.5 * t * t) / half
        z = min((x - half) / beyond, 1.0) if beyond > 0.0 else 0.0
        steep = -1.5 / half
        return steep * beyond * z * (1.0 - z) ** 2, steep * (1.0 - z) * (1.0 - 3.0 * z)
    if t >= 1.0:
        return 0.0, 0.0
    if t >= 0.5:
        return 2.0 * (1.0 - t) ** 3, -6.0 * (1.0 - t) ** 2 / half
    return 1.0 - 6.0 * t * t + 6.0 * t * t * t, (-12.0 * t + 18.0 * t * t) / half


@inner
def shifted_piece(piece: Floats, out0: float, slope0: float, out1: float, slope1: float) -> bool:
    """Move a piece of a path to the left: its ends by offsets [m], its tangents by slopes.

    Returns:
        Whether it goes on in its direction: it doesn't where the path bends too sharply that way.
    """
    d01x, d01y = piece[1, 0] - piece[0, 0], piece[1, 1] - piece[0, 1]
    d12x, d12y = piece[2, 0] - piece[1, 0], piece[2, 1] - piece[1, 1]
    d23x, d23y = piece[3, 0] - piece[2, 0], piece[3, 1] - piece[2, 1]
    first, last = math.hypot(d01x, d01y), math.hypot(d23x, d23y)
    if first < 1e-12 or last < 1e-12:
        return False
    bend0 = 2.0 / 3.0 * (d01x * d12y - d01y * d12x) / first**3
    bend1 = 2.0 / 3.0 * (d12x * d23y - d12y * d23x) / last**3
    keep0, keep1 = 1.0 - bend0 * out0, 1.0 - bend1 * out1
    if keep0 < LEAST_KEPT or keep1 < LEAST_KEPT:
        return False
    nx0, ny0 = -d01y / first, d01x / first
    nx1, ny1 = -d23y / last, d23x / last
    # Directions are those of the path and of the offset alone: with its bend, which may jump at a
    # joint, they would differ on either side of that.
    piece[0, 0] += out0 * nx0
    piece[0, 1] += out0 * ny0
    piece[3, 0] += out1 * nx1
    piece[3, 1] += out1 * ny1
    piece[1, 0] = piece[0, 0] + keep0 * (d01x + slope0 * first * nx0)
    piece[1, 1] = piece[0, 1] + keep0 * (d01y + slope0 * first * ny0)
    piece[2, 0] = piece[3, 0] - keep1 * (d23x + slope1 * last * nx1)
    piece[2, 1] = piece[3, 1] - keep1 * (d23y + slope1 * last * ny1)
    return True


@inner
def half_aside(
    spans: Floats, marks: Ints, count: int, apex: int, ahead: bool, wide: float, shortest: float,
    bend: float,
) -> tuple[float, float]:  # fmt: skip
    """How one half of a step aside is: how long, and how far it swings out beyond [m].

    Args:
        spans: The path,
        marks: its joints,
        count: and how many spans it has.
        apex: The joint that is to be farthest aside.
        ahead: Which half.
        wide: How far aside [m].
        shortest: A half that bends no more than the disc [m].
        bend: The curvature that a step aside has where there is room [1/m].

    Returns:
        See ``share_aside``; a length of 0 where there is no room.
    """
    wanted = max(shortest, math.sqrt(12.0 * abs(wide) / bend))
    k, w = (apex, 0.0) if ahead else (apex - 1, 1.0)
    k, _, room = walk_path(spans, count, marks, k, w, wanted, ahead)
    if room >= GENTLE * wanted:
        return room, -1.0
    joint = k + 1 if ahead else k
    is_end = joint == 0 or joint == count
    steep = 1.5 * abs(wide) / max(room, TOUCH_M)
    if marks[joint] == FIXED or steep > STEEPEST or room < SHORTEST_SWING * shortest:
        return room if room >= SHORTEST * shortest else 0.0, -1.0
    if is_end:
        return room, 0.0
    k, w = (joint, 0.0) if ahead else (joint - 1, 1.0)
    _, _, beyond = walk_path(spans, count, marks, k, w, 4.0 * steep / bend, ahead)
    if beyond < room:
        return room if room >= SHORTEST * shortest else 0.0, -1.0
    return room, beyond
