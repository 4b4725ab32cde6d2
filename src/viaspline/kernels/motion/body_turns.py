"""How far a body turns that looks the way its path goes: exactly, however sharply the path bends.

P' is a quadratic, so its direction only turns one way between the places where P' × P'' is zero,
and by what the legs of its control polygon turn, each by less than half a turn.

At a cusp the path goes back the way it came, and the body turns half round, on either side. What is
as good as one it turns the way of the path, at any time while it is there.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.cusps import SAME_CUSP, beside_cusps, cusps
from viaspline.kernels.jit import inlined, inner
from viaspline.kernels.motion.path_bends import BESIDE_FIRST, BESIDE_LAST, FIRST_CUSP, LAST_CUSP

AT_CUSP = (
    1e-4  # of a span, within which a body may still turn at a cusp: some nanometres of its way
)
UNSURE = 1e-6  # directions that are opposite but for so much may turn either way
SAME = 1e-12  # of a span, within which places are one


@inner
def mark_cusps(rows: Floats, bends: Floats) -> None:
    """Fill in where the spans of a path have cusps; a span has two at most."""
    count = bends.shape[0]
    spans = np.empty((count, 4, 2))
    for k in range(count):
        for i in range(2):
            spans[k, 0, i] = rows[k, 0, i]
            spans[k, 1, i] = rows[k, 0, i] + rows[k, 1, i] / 3.0
            spans[k, 2, i] = spans[k, 1, i] + (rows[k, 1, i] + rows[k, 2, i]) / 3.0
            spans[k, 3, i] = rows[k, 0, i] + rows[k, 1, i] + rows[k, 2, i] + rows[k, 3, i]
    at = cusps(spans)
    beside = beside_cusps(spans, at)
    for i in range(at.size):
        k = int(at[i])
        if math.isnan(bends[k, FIRST_CUSP]):
            bends[k, FIRST_CUSP], bends[k, BESIDE_FIRST] = at[i] - k, beside[i]
        else:
            bends[k, LAST_CUSP], bends[k, BESIDE_LAST] = at[i] - k, beside[i]


@inlined
def _cusp(bends: Floats, k: int, j: int) -> tuple[float, float]:
    """A cusp of a span by its parameter, nan for none, and how far it turns about it."""
    row = k % bends.shape[0]
    return k + bends[row, FIRST_CUSP + j], bends[row, BESIDE_FIRST + j]


@inner
def with_turns_at(bends: Floats, start: float, end: float) -> tuple[float, float]:
    """From where to where a body turns that is between two parameters.

    That is farther where it is as good as at a cusp.
    """
    first, last = start, end
    for k in range(math.floor(start), math.floor(end) + 1):
        for j in range(2):
            cusp, beside = _cusp(bends, k, j)
            if beside > SAME_CUSP and start <= cusp + beside and end >= cusp - beside:
                first, last = min(first, cusp - beside), max(last, cusp + beside)
    return first, last


@inner
def is_at_cusp(bends: Floats, start: float, end: float) -> bool:
    """Whether all between two parameters is at one true cusp."""
    for k in range(math.floor(start - AT_CUSP), math.floor(end + AT_CUSP) + 1):
        for j in range(2):
            cusp, beside = _cusp(bends, k, j)
            is_true = beside <= SAME_CUSP
            if is_true and start >= cusp - AT_CUSP and end <= cusp + AT_CUSP:
                return True
    return False


@inner
def has_cusp(bends: Floats, start: float, end: float) -> bool:
    """Whether a true cusp is between two parameters, or so near that the body may turn at it."""
    for k in range(math.floor(start - AT_CUSP), math.floor(end + AT_CUSP) + 1):
        for j in range(2):
            cusp, beside = _cusp(bends, k, j)
            if beside <= SAME_CUSP and start - AT_CUSP <= cusp <= end + AT_CUSP:
                return True
    return False


@inlined
def _angle(ax: float, ay: float, bx: float, by: float) -> float:
    """From one direction to another, the short way [rad]; nan where that may be either way."""
    across, along = ax * by - ay * bx, ax * bx + ay * by
    if along <= 0.0 and abs(across) <= UNSURE * math.sqrt(
        (ax * ax + ay * ay) * (bx * bx + by * by)
    ):
        return math.nan
    return math.atan2(across, along)


@inner
def _turn_between(row: Floats, v: float, w: float) -> float:
    """By how much the direction of a span turns where it turns one way only [rad], or nan."""
    ax = row[1, 0] + v * (2.0 * row[2, 0] + 3.0 * v * row[3, 0])
    ay = row[1, 1] + v * (2.0 * row[2, 1] + 3.0 * v * row[3, 1])
    mx = row[1, 0] + (v + w) * row[2, 0] + 3.0 * v * w * row[3, 0]
    my = row[1, 1] + (v + w) * row[2, 1] + 3.0 * v * w * row[3, 1]
    bx = row[1, 0] + w * (2.0 * row[2, 0] + 3.0 * w * row[3, 0])
    by = row[1, 1] + w * (2.0 * row[2, 1] + 3.0 * w * row[3, 1])
    return _angle(ax, ay, mx, my) + _angle(mx, my, bx, by)


@inner
def _inflections(row: Floats, v: float, w: float) -> tuple[float, float]:
    """Where P' × P'' is zero between two local parameters, in order; ``w`` for each that isn't."""
    c0 = row[1, 0] * row[2, 1] - row[1, 1] * row[2, 0]
    c1 = 3.0 * (row[1, 0] * row[3, 1] - row[1, 1] * row[3, 0])
    c2 = 3.0 * (row[2, 0] * row[3, 1] - row[2, 1] * row[3, 0])
    square = c1 * c1 - 4.0 * c2 * c0
    if square < 0.0:
        return w, w
    far = -0.5 * (c1 + math.copysign(math.sqrt(square), c1))
    one = far / c2 if c2 != 0.0 else w
    other = c0 / far if far != 0.0 else w
    one = one if v < one < w else w
    other = other if v < other < w else w
    return min(one, other), max(one, other)


@inner
def turns_between(rows: Floats, start: float, end: float) -> tuple[float, float]:
    """How far right and left of its direction at one parameter a path looks up to another.

    Args:
        rows: Coefficients of the spans; see ``TimedPath``.
        start: Parameter.
        end: Parameter, no corner and no cusp in between.

    Returns:
        (right, left): 0 or less and 0 or more [rad]; nan where that can't be told.
    """
    count = rows.shape[0] - 1
    turned, right, left = 0.0, 0.0, 0.0
    first = math.floor(start)
    for k in range(first, max(first + 1, math.ceil(end))):
        low, high = max(start - k, 0.0), min(end - k, 1.0)
        row = rows[k % count]
        one, other = _inflections(row, low, high)
        for step in range(3):
            to = one if step == 0 else (other if step == 1 else high)
            if to - low > SAME:
                turned += _turn_between(row, low, to)
                right, left = min(right, turned), max(left, turned)
                low = to
    if math.isnan(turned):
        return math.nan, math.nan
    return right, left
