"""Places along a curve, close together where it turns.

Tested through ``planning/methods/test_bent_gently``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inlined, inner, kernel, uncounted

SAMPLES = 4  # of a span
KINK_RAD = 1.0  # from step to step
LITTLE_SLOPE = 0.5  # across over along the step before: clearly less than a kink
COLLAPSED = 3e-3  # of what is required, or of the steps of its leg in the mean: no step any more


@inner
def _turn(heading: float, other: float) -> float:
    """From one heading to another, either way [rad]."""
    off = other - heading
    return abs(off - 2.0 * math.pi * math.floor(off / (2.0 * math.pi) + 0.5))


@uncounted
def _sampled(spans: Floats, points: Floats) -> None:
    for i in range(spans.shape[0]):
        for k in range(SAMPLES):
            w = k / SAMPLES
            v = 1.0 - w
            a, b, c, d = v * v * v, 3.0 * v * v * w, 3.0 * v * w * w, w * w * w
            for axis in range(2):
                points[SAMPLES * i + k, axis] = (
                    a * spans[i, 0, axis] + b * spans[i, 1, axis]
                    + c * spans[i, 2, axis] + d * spans[i, 3, axis]
                )  # fmt: skip
    for axis in range(2):
        points[-1, axis] = spans[-1, 3, axis]


@uncounted
def _wanted(points: Floats, step: float, turn: float, wanted: Floats) -> None:
    """How many places there should be up to each point."""
    heading = 0.0
    wanted[0] = 0.0
    for i in range(points.shape[0] - 1):
        dx, dy = points[i + 1, 0] - points[i, 0], points[i + 1, 1] - points[i, 1]
        here, half = math.atan2(dy, dx), 0.0
        if i > 0:  # half of a turn is before its point, half of it behind
            half = 0.5 * _turn(heading, here) / turn
        wanted[i] += half
        wanted[i + 1] = wanted[i] + math.hypot(dx, dy) / step + half
        heading = here


@kernel
def strip_places(
    spans: Floats, joints: Ints, step: float, turn: float, least: int, most: int
) -> tuple[Floats, Ints]:
    """Places along a curve, close together where it turns, its via points among them.

    Args:
        spans: Bézier control polygons [m], (m, 4, 2).
        joints: The span that begins at each via point, the first among them; m at its end, (n,).
        step: From one place to the next at most [m].
        turn: The same, by how much it turns [rad].
        least: Steps from one via point to the next.
        most: Steps in all, but for these.

    Returns:
        Places (k, 2) [m]; which of them are the via points, (n,).
    """
    points = np.empty((SAMPLES * spans.shape[0] + 1, 2))
    wanted = np.empty(points.shape[0])
    _sampled(spans, points)
    _wanted(points, step, turn, wanted)
    share = min(1.0, most / wanted[-1])
    begins = np.zeros(joints.size, np.int64)
    for leg in range(joints.size - 1):
        asked = share * (wanted[SAMPLES * joints[leg + 1]] - wanted[SAMPLES * joints[leg]])
        begins[leg + 1] = begins[leg] + max(least, math.ceil(asked))
    places = np.empty((begins[-1] + 1, 2))
    for leg in range(joints.size - 1):
        first, last = SAMPLES * joints[leg], SAMPLES * joints[leg + 1]
        count, i = begins[leg + 1] - begins[leg], first
        for k in range(count):
            asked = wanted[first] + k * (wanted[last] - wanted[first]) / count
            while i < last - 1 and wanted[i + 1] <= asked:
                i += 1
            w = (asked - wanted[i]) / (wanted[i + 1] - wanted[i])
            for axis in range(2):
                step_along = points[i + 1, axis] - points[i, axis]
                places[begins[leg] + k, axis] = points[i, axis] + w * step_along
    for axis in range(2):
        places[-1, axis] = points[-1, axis]
    return places, begins


@kernel
def places_apart(places: Floats, joints: Ints, required: float) -> Ints:
    """Which places of a row are left when those go that lie on the one before or on a via point.

    Args:
        places: [m], (n, 2).
        joints: Which of them are via points, which stay, (k,).
        required: What has to be kept about them [m].

    Returns:
        (m,).
    """
    left = np.zeros(places.shape[0], np.bool_)
    left[joints] = True
    for leg in range(joints.size - 1):
        first, last = joints[leg], joints[leg + 1]
        total = 0.0
        for j in range(first, last):
            total += _gap(places, j, j + 1)
        least = COLLAPSED * min(total / max(last - first, 1), required)
        before = first
        for j in range(first + 1, last):
            if _gap(places, before, j) >= least and _gap(places, j, last) >= least:
                left[j] = True
                before = j
    return np.flatnonzero(left)


@inlined
def _gap(places: Floats, i: int, j: int) -> float:
    """From one place to another [m]."""
    return math.hypot(places[j, 0] - places[i, 0], places[j, 1] - places[i, 1])


@kernel
def strip_normals(places: Floats, closed: bool) -> Floats:
    """Unit vectors to the left of a row of places, square to the line from neighbour to neighbour.

    Args:
        places: [m], (n, 2).
        closed: Whether it is a round, whose last place is its first.

    Returns:
        (n, 2).
    """
    count = places.shape[0]
    normals = np.empty((count, 2))
    for j in range(count):
        before, after = max(j - 1, 0), min(j + 1, count - 1)
        if closed and (j == 0 or j == count - 1):
            before, after = count - 2, 1
        dx, dy = places[after, 0] - places[before, 0], places[after, 1] - places[before, 1]
        long = math.hypot(dx, dy)
        normals[j, 0], normals[j, 1] = -dy / long, dx / long
    return normals


@uncounted
def _sharpest_step(places: Floats) -> float:
    """By how much a row of places turns from one step to the next at most [rad].

    Args:
        places: [m], (n, 2).
    """
    sharpest, heading = 0.0, 0.0
    for j in range(places.shape[0] - 1):
        dx, dy = places[j + 1, 0] - places[j, 0], places[j + 1, 1] - places[j, 1]
        here = math.atan2(dy, dx)
        if j > 0:
            sharpest = max(sharpest, _turn(heading, here))
        heading = here
    return sharpest


@uncounted
def _turns_little(places: Floats) -> bool:
    """Whether a row of places clearly has no kink, told without any angle.

    Args:
        places: [m], (n, 2).
    """
    before_x, before_y = places[1, 0] - places[0, 0], places[1, 1] - places[0, 1]
    for j in range(1, places.shape[0] - 1):
        dx, dy = places[j + 1, 0] - places[j, 0], places[j + 1, 1] - places[j, 1]
        along, across = before_x * dx + before_y * dy, before_x * dy - before_y * dx
        if not abs(across) < LITTLE_SLOPE * along:
            return False
        before_x, before_y = dx, dy
    return True


@kernel
def has_kink(places: Floats) -> bool:
    """Whether a row of places turns by ``KINK_RAD`` or more from one step to the next.

    Args:
        places: [m], (n, 2).
    """
    return not _turns_little(places) and not _sharpest_step(places) < KINK_RAD
