"""How a robot's track bows out between two instants: proven bounds from the law and the curve.

Along a curve p'' is (a, v² κ), along and across. So between two instants h apart, a track p and the
straight line that is evenly driven between the two places are never farther apart than

    h²/8 max |p''| + h/4 sum |jumps of p'|,     and than h/2 max |p'|,

where p' jumps at corners that are driven through. The curvature of a part of a span is bounded by
Bernstein coefficients of P' × P'' and |P'|²; where P' may vanish it isn't, and the other bound
counts.

Tested through ``trajectory/test_moving_certificate``.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined, inner
from viaspline.kernels.motion.timed_path import TIME, TimedPath, law_bounds

SHARPEST: Final = 0  # bound of the curvature of a span [1/m]
CORNER: Final = 1  # by how much the direction jumps where it begins: the difference of unit vectors
FIRST_CUSP: Final = 2  # where in it a span stands still and goes back, nan: nowhere, or not known;
LAST_CUSP: Final = 3  # see ``body_turns``
BESIDE_FIRST: Final = 4  # and how far in the parameter it turns about each: see ``cusps``
BESIDE_LAST: Final = 5
BEND_COLUMNS: Final = 6

ROUNDING_SHARE = 1e-13  # of its factors, below which a cross product is only rounding
JOINT_SHARE = 1e-12  # of a span, within which a place is at its end


@inlined
def _slope(rows: Floats, k: int, i: int, v: float, w: float) -> float:
    """The blossom of P' along axis i at two local parameters: a control vector's coordinate."""
    return rows[k, 1, i] + (v + w) * rows[k, 2, i] + 3.0 * v * w * rows[k, 3, i]


@inlined
def _bend(rows: Floats, k: int, i: int, w: float) -> float:
    """P'' along axis i."""
    return 2.0 * rows[k, 2, i] + 6.0 * w * rows[k, 3, i]


@inner
def _across_squared(rows: Floats, k: int, v: float, w: float) -> float:
    """Largest squared Bernstein coefficient of P' × P'' between two local parameters."""
    c0, c1, c2, c3 = 0.0, 0.0, 0.0, 0.0
    for i in range(rows.shape[2]):
        for j in range(i):
            ai, aj = _bend(rows, k, i, v), _bend(rows, k, j, v)
            bi, bj = _bend(rows, k, i, w), _bend(rows, k, j, w)
            xi, xj = _slope(rows, k, i, v, v), _slope(rows, k, j, v, v)
            yi, yj = _slope(rows, k, i, v, w), _slope(rows, k, j, v, w)
            zi, zj = _slope(rows, k, i, w, w), _slope(rows, k, j, w, w)
            c0 += (xi * aj - xj * ai) ** 2
            c1 += ((xi * bj - xj * bi + 2.0 * (yi * aj - yj * ai)) / 3.0) ** 2
            c2 += ((2.0 * (yi * bj - yj * bi) + zi * aj - zj * ai) / 3.0) ** 2
            c3 += (zi * bj - zj * bi) ** 2
    return max(max(c0, c1), max(c2, c3))


@inner
def sharpest(rows: Floats, k: int, v: float, w: float) -> float:
    """Upper bound of the curvature between two local parameters of a span [1/m].

    Infinite where it may stand still and go back, on a straight line as well.
    """
    g0, g1, g2, g3, g4, bend, ends = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(rows.shape[2]):
        x, y, z = _slope(rows, k, i, v, v), _slope(rows, k, i, v, w), _slope(rows, k, i, w, w)
        g0 += x * x
        g1 += x * y
        g2 += (x * z + 2.0 * y * y) / 3.0
        g3 += y * z
        g4 += z * z
        ends += x * z
        bend += max(_bend(rows, k, i, v) ** 2, _bend(rows, k, i, w) ** 2)
    across = _across_squared(rows, k, v, w)
    if across <= ROUNDING_SHARE * ROUNDING_SHARE * bend * max(g0, max(g2, g4)):
        turns_back = min(ends, min(g1, g3)) < -ROUNDING_SHARE * max(g0, max(g2, g4))
        return np.inf if turns_back else 0.0
    least = min(min(min(g0, g1), min(g2, g3)), g4)
    return math.sqrt(across / least) / least if least > 0.0 else np.inf


@inner
def towards(rows: Floats, k: int, last: bool, out: Floats) -> None:
    """Unit vector in which a span begins or ends, (d,); zero if it is a single point."""
    for attempt in range(3):
        size = 0.0
        for i in range(rows.shape[2]):
            first = rows[k, 1, i]
            second = first + rows[k, 2, i]
            third = second + rows[k, 2, i] + 3.0 * rows[k, 3, i]
            j = 2 - attempt if last else attempt
            out[i] = first if j == 0 else (second if j == 1 else third)
            size += out[i] * out[i]
        if size > 0.0:
            for i in range(rows.shape[2]):
                out[i] /= math.sqrt(size)
            return


@inner
def bends_of(path: TimedPath) -> Floats:
    """SHARPEST and CORNER of every span, no cusps, (m, BEND_COLUMNS)."""
    rows = path.rows
    count = rows.shape[0] - 1
    bends = np.zeros((count, BEND_COLUMNS))
    before = np.zeros(rows.shape[2])
    after = np.zeros(rows.shape[2])
    for k in range(count):
        bends[k, FIRST_CUSP] = bends[k, LAST_CUSP] = np.nan
        bends[k, SHARPEST] = sharpest(rows, k, 0.0, 1.0)
        if k > 0 or path.closed:
            towards(rows, k - 1 if k > 0 else count - 1, True, before)
            towards(rows, k, False, after)
            squared = 0.0
            for i in range(rows.shape[2]):
                squared += (after[i] - before[i]) ** 2
            bends[k, CORNER] = math.sqrt(squared)
    return bends


@inner
def bend_bounds(rows: Floats, bends: Floats, start: float, end: float) -> tuple[float, float]:
    """Between two parameters: a bound of the curvature [1/m], and the sum of the corners."""
    count = bends.shape[0]
    curvature = 0.0
    corners = 0.0
    first = math.floor(start)
    for k in range(first, max(first + 1, math.ceil(end))):
        row = k % count
        if start < k - JOINT_SHARE and k < end - JOINT_SHARE:
            corners += bends[row, CORNER]
        if bends[row, SHARPEST] > curvature:
            low = max(start - k, 0.0)
            high = min(end - k, 1.0)
            whole = low == 0.0 and high == 1.0
            part = bends[row, SHARPEST] if whole else sharpest(rows, row, low, high)
            curvature = max(curvature, part)
    return curvature, corners


@inner
def sag(
    path: TimedPath, bends: Floats, begin: float, end: float, first: float, last: float
) -> float:
    """How far the track is from the line that is evenly driven between two instants, at most [m].

    Args:
        path: TimedPath.
        bends: See ``bends_of``.
        begin: The earlier instant [s].
        end: The later one [s].
        first: Parameter of the curve at the earlier one.
        last: At the later one.
    """
    law = path.law
    if begin >= law[law.shape[0] - 1, TIME]:
        return 0.0
    speed, acceleration, jump = law_bounds(law, begin, end)
    if speed == 0.0:
        return jump
    lasts = end - begin
    curvature, corners = bend_bounds(path.rows, bends, first, last)
    across = speed * speed * curvature
    bow = math.sqrt(acceleration * acceleration + across * across) * lasts * lasts / 8.0
    return jump + min(bow + 0.25 * lasts * speed * corners, 0.5 * lasts * speed)
