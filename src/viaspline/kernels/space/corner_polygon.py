"""The polyline of a leg with its stubs and its corners, and how far each corner's rounding reaches.

A corner is moved outward by what its rounding cuts off; that changes how much it turns, and so on:
a few rounds of that settle it. Tested through ``space/laying/test_leg_polygon``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.space.shared_sides import shared_radii

C2 = 0.4 * (math.sqrt(6.0) - 1.0)
C3 = (C2 + 4.0) / ((1.0 + C2) * (C2 + 4.0) + 6.0)
C4 = (C2 + 4.0) ** 2 / (54.0 * C3)
"""Of a corner's two spirals; see ``space/laying/corner_rounding``."""

CUT = 1.0 - C3 * (1.0 + C2)
"""How near a rounding comes to the corner, of its reach and the sine of half the turn."""

SHARPEST_TURN = math.radians(175.0)
"""What turns by more than that has no rounding: the robot has to stop there."""

STRAIGHT = 1e-9
"""What turns by less than that [rad] is no corner."""

STUB_SHARE = 0.4
"""Of the way to the next corner that the stub at a via point may take."""

LEAST_STUB = 1e-6
"""Of that way it always takes this much, so that a direction is kept however tight it gets."""

SETTLING = 8
"""How often corners are moved outward, and stubs made longer."""

STUBS_SETTLING = 4
"""How often two stubs with nothing between them are pointed at each other's ends."""


@kernel
def corner_polygon(points: Floats, directions: Floats, radii: Floats) -> tuple[Floats, Floats]:
    """The polyline of a leg, and the reaches of its corners.

    Args:
        points: First via point, detour via points and last via point [m], (k + 2, d).
        directions: At the first and the last, unit vectors, (2, d); NaN where it is free.
        radii: Of curvature, to be had if there is room [m], (k + 2,).

    Returns:
        (polygon, reaches): [m], (n, d) and (n - 2,): no reach goes into another one.
    """
    polygon, wanted = _with_stubs(points, points, directions, radii)
    first = 1 if math.isnan(directions[0, 0]) else 2
    corners = points.copy()
    for _ in range(SETTLING if len(points) > 2 else 0):
        reaches = _reaches(polygon, wanted)
        for k in range(1, len(points) - 1):
            corner = first + k - 1
            size = _outward(polygon, corner, corners[k])
            turn = turn_at(polygon, corner)
            by = CUT * math.sin(0.5 * turn) * reaches[corner - 1]
            for axis in range(points.shape[1]):
                out = corners[k, axis] / size if size > STRAIGHT else 0.0
                corners[k, axis] = points[k, axis] + by * out
        polygon, wanted = _with_stubs(points, corners, directions, radii)
    return polygon, _reaches(polygon, wanted)


@inner
def _with_stubs(
    points: Floats, corners: Floats, directions: Floats, radii: Floats
) -> tuple[Floats, Floats]:
    """The polyline through corners with its stubs, and the radii of its inner places."""
    count, axes = points.shape
    begins, ends = not math.isnan(directions[0, 0]), not math.isnan(directions[1, 0])
    polygon = np.empty((count + begins + ends, axes))
    wanted = np.empty(len(polygon) - 2)
    for axis in range(axes):
        polygon[0, axis] = points[0, axis]
        polygon[len(polygon) - 1, axis] = points[count - 1, axis]
    if begins:
        polygon[1] = points[0]
    if ends:
        polygon[len(polygon) - 2] = points[count - 1]
    for k in range(1, count - 1):
        wanted[k - 1 + begins] = radii[k]
        for axis in range(axes):
            polygon[k + begins, axis] = corners[k, axis]
    if begins:
        wanted[0] = radii[0]
    if ends:
        wanted[len(wanted) - 1] = radii[count - 1]
    both = begins and ends and count == 2  # the one stub points at the end of the other
    for _ in range(STUBS_SETTLING if both else 1):
        if begins:
            beside = corners[1]
            if both:
                beside = polygon[2]
            stub = stub_length(beside - points[0], directions[0], radii[0])
            for axis in range(axes):
                polygon[1, axis] = points[0, axis] + stub * directions[0, axis]
        if ends:
            beside = corners[count - 2]
            if both:
                beside = polygon[1]
            stub = stub_length(beside - points[count - 1], -directions[1], radii[count - 1])
            for axis in range(axes):
                at = points[count - 1, axis] - stub * directions[1, axis]
                polygon[len(polygon) - 2, axis] = at
    return polygon, wanted


@kernel
def stub_length(apart: Floats, way: Floats, radius: float) -> float:
    """How far to go straight from a via point [m]: the farther, the more there is to turn then.

    Args:
        apart: From the via point to what is next [m], (d,).
        way: The direction in which it goes, a unit vector, (d,).
        radius: Of the turn at the end [m].
    """
    distance = along = 0.0
    for axis in range(len(way)):
        distance += apart[axis] * apart[axis]
        along += apart[axis] * way[axis]
    across = math.sqrt(max(distance - along * along, 0.0))
    distance = math.sqrt(distance)
    most, stub = STUB_SHARE * distance, LEAST_STUB * distance
    for _ in range(SETTLING):
        turn = min(math.atan2(across, along - stub), SHARPEST_TURN)
        stub = min(most, max(stub, radius * reach_of_one(turn)))
    return stub


@inner
def _reaches(polygon: Floats, wanted: Floats) -> Floats:
    """How far the rounding of each inner corner reaches [m]; those that share a side, fairly."""
    count = len(wanted)
    of_one, sides = np.empty(count), np.empty(count + 1)
    for k in range(count + 1):
        sides[k] = side_length(polygon, k)
    for k in range(count):
        turn = turn_at(polygon, k + 1)
        of_one[k] = reach_of_one(turn) if STRAIGHT < turn < SHARPEST_TURN else 0.0
    radii = shared_radii(sides, of_one, wanted)
    for k in range(count):
        radii[k] *= of_one[k]
    return radii


@inner
def reach_of_one(turn: float) -> float:
    """How far before a corner [m] the rounding begins whose radius is 1 m."""
    half = 0.5 * turn
    cosine = math.cos(half)
    return C4 * math.sin(half) / (cosine * cosine)


@inner
def side_length(polygon: Floats, k: int) -> float:
    """Length of a side [m]."""
    total = 0.0
    for axis in range(polygon.shape[1]):
        step = polygon[k + 1, axis] - polygon[k, axis]
        total += step * step
    return math.sqrt(total)


@inner
def turn_at(polygon: Floats, k: int) -> float:
    """By how much a polyline turns at a corner [rad]."""
    before, after = side_length(polygon, k - 1), side_length(polygon, k)
    across = along = 0.0
    for axis in range(polygon.shape[1]):
        one = (polygon[k, axis] - polygon[k - 1, axis]) / before
        other = (polygon[k + 1, axis] - polygon[k, axis]) / after
        across += (other - one) * (other - one)
        along += (other + one) * (other + one)
    return 2.0 * math.atan2(math.sqrt(across), math.sqrt(along))


@inner
def _outward(polygon: Floats, k: int, out: Floats) -> float:
    """The way out of a corner, away from the side to which it turns, and its length."""
    before, after = side_length(polygon, k - 1), side_length(polygon, k)
    total = 0.0
    for axis in range(polygon.shape[1]):
        one = (polygon[k, axis] - polygon[k - 1, axis]) / before
        other = (polygon[k + 1, axis] - polygon[k, axis]) / after
        out[axis] = one - other
        total += (one - other) * (one - other)
    return math.sqrt(total)
