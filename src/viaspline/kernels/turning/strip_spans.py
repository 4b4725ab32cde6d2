"""The spline through the places of a strip, for each kind of ends that a strip may have.

An end is free, and nothing bends it; or its direction is given, where another curve goes on without
a bend: then it leads there without one, for which the place beside it gives way a little. A round
goes on at its end where it begins.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel, uncounted

STRAIGHT = 1e-11  # of what an end bends on its first step: it doesn't [rad]
MAX_ROUNDS = 8
PROBE = 1e-3  # of a step, by which a place is moved to see what that changes


class _Spline(NamedTuple):
    """The equations of a spline's derivatives at places, eliminated from the first on.

    Attributes:
        per: One over each step [1/m], (n - 1,).
        diagonal: (n,).
        above: (n,).
        rises: Right sides before anything is eliminated, (n, 2).
    """

    per: Floats
    diagonal: Floats
    above: Floats
    rises: Floats


@inner
def _room(count: int) -> _Spline:
    """Equations for so many places, to be filled."""
    return _Spline(np.empty(count - 1), np.empty(count), np.empty(count), np.empty((count, 2)))


@uncounted
def _is_given(ends: Floats, j: int, count: int) -> bool:
    """Whether the derivative at a place is given."""
    return (j == 0 and not math.isnan(ends[0, 0])) or (
        j == count - 1 and not math.isnan(ends[1, 0])
    )


@uncounted
def _set_equations(places: Floats, steps: Floats, ends: Floats, spline: _Spline) -> None:
    """Fill the equations of a spline, which of its ends are given among them."""
    count = places.shape[0]
    per, diagonals, above, rises = spline
    before, over = 0.0, 0.0  # of the step before, of the place before
    for j in range(count):
        after = 1.0 / steps[j] if j < count - 1 else 0.0
        if j < count - 1:
            per[j] = after
        if _is_given(ends, j, count):
            above[j], before, over = 0.0, after, 0.0
            continue
        diagonal, x, y = 0.0, 0.0, 0.0
        if j > 0:
            diagonal += 2.0 * before
            x += 3.0 * before * before * (places[j, 0] - places[j - 1, 0])
            y += 3.0 * before * before * (places[j, 1] - places[j - 1, 1])
        if j < count - 1:
            diagonal += 2.0 * after
            x += 3.0 * after * after * (places[j + 1, 0] - places[j, 0])
            y += 3.0 * after * after * (places[j + 1, 1] - places[j, 1])
        if j > 0:
            diagonal -= before * over
        over = after / diagonal
        rises[j, 0], rises[j, 1] = x, y
        above[j], diagonals[j], before = over, diagonal, after


@uncounted
def _solve(spline: _Spline, ends: Floats, tangents: Floats) -> None:
    """The spline's derivatives by its parameter at places; where none is given at an end, free.

    What one place hands to the next is held outside of arrays: it is sooner at hand.
    """
    count = tangents.shape[0]
    per, diagonal, above, rises = spline
    x, y = 0.0, 0.0
    for j in range(count):
        if _is_given(ends, j, count):
            x, y = ends[min(j, 1), 0], ends[min(j, 1), 1]
        elif j > 0:
            x = (rises[j, 0] - per[j - 1] * x) / diagonal[j]
            y = (rises[j, 1] - per[j - 1] * y) / diagonal[j]
        else:
            x, y = rises[j, 0] / diagonal[j], rises[j, 1] / diagonal[j]
        tangents[j, 0], tangents[j, 1] = x, y
    for j in range(count - 2, -1, -1):
        x, y = tangents[j, 0] - above[j] * x, tangents[j, 1] - above[j] * y
        tangents[j, 0], tangents[j, 1] = x, y


@uncounted
def _solve_both(
    spline: _Spline, first: float, second: float, tangents: Floats, others: Floats
) -> None:
    """As ``_solve`` with both ends given, twice: side by side that takes hardly longer than once.

    Args:
        spline: Of at least three places.
        first: Both coordinates of the derivative at both ends, once,
        second: and the other time.
        tangents: Of the first, (n, 2); filled.
        others: Of the second, (n, 2); filled.
    """
    last = tangents.shape[0] - 1
    per, diagonal, above, rises = spline
    x, y, u, v = first, first, second, second
    for j in range(last):
        if j > 0:
            x = (rises[j, 0] - per[j - 1] * x) / diagonal[j]
            y = (rises[j, 1] - per[j - 1] * y) / diagonal[j]
            u = (rises[j, 0] - per[j - 1] * u) / diagonal[j]
            v = (rises[j, 1] - per[j - 1] * v) / diagonal[j]
        tangents[j, 0], tangents[j, 1], others[j, 0], others[j, 1] = x, y, u, v
    x, y, u, v = first, first, second, second
    tangents[last, 0], tangents[last, 1], others[last, 0], others[last, 1] = x, y, u, v
    for j in range(last - 1, -1, -1):
        x, y = tangents[j, 0] - above[j] * x, tangents[j, 1] - above[j] * y
        u, v = others[j, 0] - above[j] * u, others[j, 1] - above[j] * v
        tangents[j, 0], tangents[j, 1], others[j, 0], others[j, 1] = x, y, u, v


@uncounted
def _steps(places: Floats, steps: Floats) -> None:
    for j in range(steps.size):
        dx, dy = places[j + 1, 0] - places[j, 0], places[j + 1, 1] - places[j, 1]
        steps[j] = math.hypot(dx, dy)


@uncounted
def _bent_at(places: Floats, steps: Floats, tangents: Floats, end: int, axis: int) -> float:
    """The second derivative at an end, 0 the first and 1 the last, along an axis [1/m]."""
    if end == 0:
        rise, step = places[1, axis] - places[0, axis], steps[0]
        return 6.0 * rise / step**2 - (4.0 * tangents[0, axis] + 2.0 * tangents[1, axis]) / step
    last = places.shape[0] - 1
    rise, step = places[last - 1, axis] - places[last, axis], steps[last - 1]
    return (
        6.0 * rise / step**2 + (4.0 * tangents[last, axis] + 2.0 * tangents[last - 1, axis]) / step
    )


@inner
def _round(places: Floats, steps: Floats, tangents: Floats) -> None:
    """The tangents of a round: that at its seam from what its second derivative jumps by there."""
    last = places.shape[0] - 1
    ends, spline, others = np.zeros((2, 2)), _room(last + 1), np.empty((last + 1, 2))
    _set_equations(places, steps, ends, spline)
    _solve_both(spline, 0.0, 1.0, tangents, others)
    for axis in range(2):
        jumps = _bent_at(places, steps, tangents, 0, axis)
        jumps -= _bent_at(places, steps, tangents, 1, axis)
        jump = _bent_at(places, steps, others, 0, axis)
        jump -= _bent_at(places, steps, others, 1, axis)
        ends[0, axis] = ends[1, axis] = jumps / (jumps - jump)
    _solve(spline, ends, tangents)
    for axis in range(2):
        tangents[last, axis] = tangents[0, axis]


@inner
def _straight_ends(
    places: Floats, normals: Floats, steps: Floats, ends: Floats, tangents: Floats
) -> None:  # fmt: skip
    """Move the places beside given ends along their normals until nothing bends there."""
    count = places.shape[0]
    bent, moved, spline = np.zeros(2), np.zeros(2), _room(count)
    for rounds in range(MAX_ROUNDS):
        _steps(places, steps)
        _set_equations(places, steps, ends, spline)
        _solve(spline, ends, tangents)
        worst = 0.0
        for end in range(2):
            if math.isnan(ends[end, 0]):
                continue
            place, step = (1, steps[0]) if end == 0 else (count - 2, steps[count - 2])
            here = ends[end, 0] * _bent_at(places, steps, tangents, end, 1)
            here -= ends[end, 1] * _bent_at(places, steps, tangents, end, 0)
            worst = max(worst, abs(here) * step)
            change = here - bent[end]
            move = PROBE * step
            if rounds > 0:
                move = -here * moved[end] / change if change != 0.0 else 0.0
            bent[end], moved[end] = here, move
        if worst < STRAIGHT:
            break
        for end in range(2):
            if not math.isnan(ends[end, 0]):
                place = 1 if end == 0 else count - 2
                for axis in range(2):
                    places[place, axis] += moved[end] * normals[place, axis]


@kernel
def strip_spans(places: Floats, normals: Floats, ends: Floats, closed: bool) -> Floats:
    """The cubic spline through places, its parameter their distances.

    Args:
        places: [m], none at the place of the one before, (n, 2); those beside given ends are moved
            so that it doesn't bend there.
        normals: Along which they are, (n, 2).
        ends: Directions in which it leaves the first place and comes to the last, unit vectors, nan
            where it is free, (2, 2).
        closed: Whether it is a round, whose last place is its first; its ends are not looked at.

    Returns:
        Bézier control polygons (n - 1, 4, 2) [m]; their curvature is continuous, and none at ends.
    """
    count = places.shape[0]
    steps, tangents = np.empty(count - 1), np.empty((count, 2))
    if closed:
        _steps(places, steps)
        _round(places, steps, tangents)
    else:
        _straight_ends(places, normals, steps, ends, tangents)
    spans = np.empty((count - 1, 4, 2))
    for j in range(count - 1):
        for axis in range(2):
            spans[j, 0, axis], spans[j, 3, axis] = places[j, axis], places[j + 1, axis]
            spans[j, 1, axis] = places[j, axis] + steps[j] / 3.0 * tangents[j, axis]
            spans[j, 2, axis] = places[j + 1, axis] - steps[j] / 3.0 * tangents[j + 1, axis]
    return spans
