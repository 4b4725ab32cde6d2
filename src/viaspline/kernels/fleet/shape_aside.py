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
LEAST_SIDE_M = 1e-12
"""Shorter sides of a span's polygon have no direction."""
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
def _bend(x0: float, y0: float, x1: float, y1: float, first: bool) -> float:
    """Curvature at an end of a cubic between two sides of its polygon, at the first or the last."""
    side = math.hypot(x0, y0) if first else math.hypot(x1, y1)
    return 2.0 / 3.0 * (x0 * y1 - y0 * x1) / side**3 if side >= LEAST_SIDE_M else 0.0


@inner
def joint_bend(spans: Floats, count: int, joint: int) -> float:
    """Curvature at a joint of a path [1/m]: the mean of both sides, which may jump there."""
    bend, sides = 0.0, 0
    if joint > 0:
        p = spans[joint - 1]
        bend += _bend(
            p[2, 0] - p[1, 0], p[2, 1] - p[1, 1], p[3, 0] - p[2, 0], p[3, 1] - p[2, 1], False
        )
        sides += 1
    if joint < count:
        p = spans[joint]
        bend += _bend(
            p[1, 0] - p[0, 0], p[1, 1] - p[0, 1], p[2, 0] - p[1, 0], p[2, 1] - p[1, 1], True
        )
        sides += 1
    return bend / max(sides, 1)


@inner
def shifted_piece(
    piece: Floats, out0: float, slope0: float, bend0: float, out1: float, slope1: float,
    bend1: float,
) -> bool:  # fmt: skip
    """Move a piece of a path to the left: its ends by offsets [m], its tangents by slopes.

    Where a path with the tangent T, the normal N and the curvature k is led aside by o, it goes on
    along (1 - k o) T + o' N. The curvatures are those of ``joint_bend``: either side of a joint is
    led on in the same direction then.

    Returns:
        Whether it goes on in its direction: it doesn't where the path bends too sharply that way.
    """
    d01x, d01y = piece[1, 0] - piece[0, 0], piece[1, 1] - piece[0, 1]
    d23x, d23y = piece[3, 0] - piece[2, 0], piece[3, 1] - piece[2, 1]
    first, last = math.hypot(d01x, d01y), math.hypot(d23x, d23y)
    if first < LEAST_SIDE_M or last < LEAST_SIDE_M:
        return False
    keep0, keep1 = 1.0 - bend0 * out0, 1.0 - bend1 * out1
    if keep0 < LEAST_KEPT or keep1 < LEAST_KEPT:
        return False
    piece[0, 0] -= out0 * d01y / first
    piece[0, 1] += out0 * d01x / first
    piece[3, 0] -= out1 * d23y / last
    piece[3, 1] += out1 * d23x / last
    piece[1, 0] = piece[0, 0] + keep0 * d01x - slope0 * d01y
    piece[1, 1] = piece[0, 1] + keep0 * d01y + slope0 * d01x
    piece[2, 0] = piece[3, 0] - keep1 * d23x + slope1 * d23y
    piece[2, 1] = piece[3, 1] - keep1 * d23y - slope1 * d23x
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
