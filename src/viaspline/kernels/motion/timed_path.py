"""Where a robot is when: the exact point of a curve at an instant of its time law.

The law is a row of pieces, in each of which the acceleration is constant, or changes evenly with
the distance or with time; see ``trajectory.motion_pieces``.

Tested through ``trajectory/test_moving_certificate``.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple

from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.arclength import along_panel, panel_of
from viaspline.kernels.jit import inner

TIME: Final = 0  # when a piece of the law begins [s]
DISTANCE: Final = 1  # where, along the curve [m]
SPEED: Final = 2  # [m/s]
ACCELERATION: Final = 3  # [m/s²]
CHANGE: Final = 4  # of the acceleration with the distance [1/s²]
JERK: Final = 5  # with time [m/s³]
LAW_COLUMNS: Final = 6

SERIES_LIMIT = 1e-4  # below this a series of two terms is exact to rounding


class TimedPath(NamedTuple):
    """A curve and the time law along it.

    Attributes:
        rows: Taylor coefficients of the curve's spans; see ``kernels.curve.cubic``, (m + 1, 4, d).
        at: Parameters at which panels of the length integral meet, (p + 1,).
        along: The distances there [m], (p + 1,).
        closed: Whether the curve is closed; its distances then go on, lap after lap.
        law: In the order of time; the last row is the end of the law, (n, LAW_COLUMNS), n >= 2.
    """

    rows: Floats
    at: Floats
    along: Floats
    closed: bool
    law: Floats


@inner
def law_piece(law: Floats, instant: float) -> int:
    """The piece of a law at an instant [s]."""
    low = 0
    high = law.shape[0] - 2
    while low < high:
        middle = (low + high + 1) // 2
        if law[middle, TIME] <= instant:
            low = middle
        else:
            high = middle - 1
    return low


@inner
def _slope(square: float) -> float:
    """sinh(x) / x for x² = square, which may be negative: then it is sin(|x|) / |x|."""
    x = math.sqrt(abs(square))
    if x < SERIES_LIMIT:
        return 1.0 + square / 6.0
    return math.sin(x) / x if square < 0.0 else math.sinh(min(x, 700.0)) / x


@inner
def law_state(law: Floats, i: int, instant: float) -> tuple[float, float, float]:
    """Distance [m], speed [m/s] and acceleration [m/s²] on piece i of a law at an instant [s]."""
    late = max(0.0, min(instant, law[i + 1, TIME]) - law[i, TIME])
    v = law[i, SPEED]
    a = law[i, ACCELERATION]
    k = law[i, CHANGE]
    j = law[i, JERK]
    if k == 0.0 and j == 0.0:
        distance = law[i, DISTANCE] + (v + 0.5 * a * late) * late
        return min(max(distance, law[i, DISTANCE]), law[i + 1, DISTANCE]), v + a * late, a
    odd = late * _slope(k * late * late)
    even = 0.5 * (late * _slope(0.25 * k * late * late)) ** 2
    further = v * odd + a * even + j * late**3 / 6.0
    distance = min(max(law[i, DISTANCE] + further, law[i, DISTANCE]), law[i + 1, DISTANCE])
    speed = v * (1.0 + k * even) + a * odd + 0.5 * j * late * late
    return distance, max(speed, 0.0), a + k * further + j * late


@inner
def law_bounds(law: Floats, begin: float, end: float) -> tuple[float, float, float]:
    """What a law does between two instants [s], from its start to its end.

    Returns:
        (speed, acceleration, jump): the largest speed [m/s] and absolute acceleration [m/s²], and
        by how much the distance jumps, which it does in stretches too short to have a speed [m].
    """
    speed = 0.0
    acceleration = 0.0
    jump = 0.0
    for i in range(law_piece(law, begin), law.shape[0] - 1):
        if law[i, TIME] >= end:
            break
        _, v0, a0 = law_state(law, i, max(begin, law[i, TIME]))
        s1, v1, a1 = law_state(law, i, end)
        speed = max(speed, max(v0, v1))
        acceleration = max(acceleration, max(abs(a0), abs(a1)))
        if a0 > 0.0 > a1:  # it is fastest in between
            speed = max(speed, math.sqrt(v0 * v0 + a0 * a0 / abs(law[i, CHANGE])))
        if law[i + 1, TIME] <= end:
            jump += law[i + 1, DISTANCE] - s1
    return speed, acceleration, jump


@inner
def place_of(path: TimedPath, distance: float) -> tuple[float, float, float]:
    """Parameter and x, y [m] at a distance along the curve [m]; both go on lap after lap."""
    spans = path.rows.shape[0] - 1
    length = path.along[path.along.size - 1]
    laps = 0.0
    if path.closed and length > 0.0:
        laps = math.floor(distance / length)
    s = min(max(distance - laps * length, 0.0), length)
    panel = panel_of(path.along, s)
    k = int(path.at[panel])
    start = path.at[panel] - k
    end = path.at[panel + 1] - k
    step = s - path.along[panel]
    whole = path.along[panel + 1] - path.along[panel]
    w = end
    if step <= 0.0:
        w = start
    elif step < whole:
        w = along_panel(path.rows, k, start, end, step, step / whole, 1e-15 * length)
    row = path.rows[k]
    x = row[0, 0] + w * (row[1, 0] + w * (row[2, 0] + w * row[3, 0]))
    y = row[0, 1] + w * (row[1, 1] + w * (row[2, 1] + w * row[3, 1]))
    return laps * spans + k + w, x, y


@inner
def place_at(path: TimedPath, instant: float) -> tuple[float, float, float]:
    """Parameter and x, y [m] at an instant [s]; at rest before the law and after it."""
    distance, _, _ = law_state(path.law, law_piece(path.law, instant), instant)
    return place_of(path, distance)
