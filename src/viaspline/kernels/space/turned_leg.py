"""The curve of a leg that ends in turns through its via points.

Half a turn points at the corner that is next to it. Rounding moves that corner outward, by how much
it turns there, so the half turn is pointed at it anew, until the way between goes on straight: else
the robot would bend one way, back a little, and on. What lies beside the plane of the turn is left
to a wide bend behind it. Tested through ``space/laying/test_leg_polygon``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.space.corner_polygon import corner_polygon, turn_at
from viaspline.kernels.space.half_turns import half_turn, turn_radius
from viaspline.kernels.space.rounded_corners import rounded_corners

GENTLER = 100.0
"""Than the turn at a via point itself is what is left to turn behind it, if there is room."""

STRAIGHT = 2e-6
"""What is left to turn there by less than that [rad] isn't: bends of micrometres are noise."""

AIMS = 4
"""How often turns are pointed anew at what is next."""

LEAST_PART = 0.25
"""Of a half turn towards the corner as it was that is left when it is pointed anew, at least."""


@kernel
def turned_leg(points: Floats, directions: Floats, radii: Floats, turns: Floats) -> Floats:
    """The curve of a leg with a turn at its first or its last via point, or at both.

    Args:
        points: First via point, detour via points and last via point [m], (k + 2, d).
        directions: At the first and the last, unit vectors, (2, d); NaN where it is free.
        radii: Of curvature, to be had if there is room [m], (k + 2,).
        turns: At the first and the last; see ``via_turns``, (2, 2 d + 3), NaN where there is none.

    Returns:
        Bézier control polygons [m], (m, 4, d).
    """
    count, axes = points.shape
    has = ~np.isnan(turns[:, 2 * axes + 2])
    between, ways, wanted = points.copy(), directions.copy(), radii.copy()
    halves = np.zeros((2, 4, axes))
    next_to = np.empty((2, axes))
    next_to[0], next_to[1] = points[1], points[count - 2]
    for end in range(2):
        if has[end]:
            wanted[end * (count - 1)] *= GENTLER
    polygon, reaches = points, radii  # of that kind; both are made below
    for aim in range(AIMS):
        for end in range(2):
            if has[end]:
                at = end * (count - 1)
                least = LEAST_PART * _length(halves[end]) if aim > 0 else 0.0
                _point(points[at], turns[end], radii[at], next_to[end], end, least, halves)
                between[at] = halves[end, 3]
                _along(halves[end], end, ways[end])
        polygon, reaches = corner_polygon(between, ways, wanted)
        last = len(polygon) - 1
        left = turn_at(polygon, 1) if has[0] else 0.0
        left = max(left, turn_at(polygon, last - 1)) if has[1] else left
        if left < STRAIGHT:
            break
        next_to[0], next_to[1] = polygon[2], polygon[last - 2]
    straight = False
    for end in range(2):
        corner = 1 + end * (len(polygon) - 3)
        if has[end] and turn_at(polygon, corner) < STRAIGHT:
            ways[end] = np.nan
            straight = True
    if straight:
        polygon, reaches = corner_polygon(between, ways, wanted)
    return _joined(has, halves, rounded_corners(polygon, reaches))


@inner
def _point(
    via: Floats,
    turn: Floats,
    wanted: float,
    towards: Floats,
    end: int,
    least: float,
    halves: Floats,
) -> None:
    """Write half of a turn at one end of a leg, from its via point on, towards a place.

    That which is there stays where less than the least length [m] of it would be left.
    """
    axes = len(via)
    sign = 1.0 - 2.0 * end
    way, inside = sign * turn[:axes], turn[axes : 2 * axes].copy()
    half = half_turn(via, way, inside, towards, turn_radius(turn, wanted))
    if _length(half) >= least:
        halves[end] = half


@inner
def _length(half: Floats) -> float:
    """From end to end of half a turn [m]."""
    square = 0.0
    for axis in range(half.shape[1]):
        square += (half[3, axis] - half[0, axis]) ** 2
    return np.sqrt(square)


@inner
def _along(half: Floats, end: int, way: Floats) -> None:
    """Write the direction of a leg where half a turn at one of its ends meets the rest of it."""
    size = 0.0
    for axis in range(len(way)):
        way[axis] = (half[3, axis] - half[2, axis]) * (1.0 - 2.0 * end)
        size += way[axis] * way[axis]
    for axis in range(len(way)):
        way[axis] /= np.sqrt(size)


@inner
def _joined(has: Floats, halves: Floats, spans: Floats) -> Floats:
    """Half a turn, the spans between, and half a turn."""
    before = int(has[0])
    whole = np.empty((before + len(spans) + int(has[1]), 4, spans.shape[2]))
    if has[0]:
        whole[0] = halves[0]
    whole[before : before + len(spans)] = spans
    if has[1]:
        for k in range(4):
            whole[len(whole) - 1, k] = halves[1, 3 - k]
    return whole
