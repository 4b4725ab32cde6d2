"""Strides: pieces of a robot's drive in which it goes evenly, but for a sag that is known.

Tested through ``trajectory/test_moving_certificate``.
"""

from __future__ import annotations

from typing import Final

from viaspline.kernels.arrays import Floats
from viaspline.kernels.growable import new_floats, sized_floats
from viaspline.kernels.jit import inner
from viaspline.kernels.motion.path_bends import sag
from viaspline.kernels.motion.timed_path import TIME, TimedPath, law_piece, place_at

BEGIN: Final = 0  # the first instant [s]
END: Final = 1  # the last one [s]
X0: Final = 2  # where the robot is at the first one [m]
Y0: Final = 3
U0: Final = 4  # as a parameter of the curve
X1: Final = 5  # where it is at the last one
Y1: Final = 6
U1: Final = 7
SAG: Final = 8  # how far its track is from the straight line, at most [m]
STRIDE_COLUMNS: Final = 9

SHORTEST_S = 1e-9  # a stride that is no longer is an instant [s]
MAX_STACK = 256  # halvings, of knots and of time


@inner
def halving_instant(law: Floats, begin: float, end: float) -> float:
    """Where to cut a stride: at the point of the law next to its middle, else in the middle [s]."""
    middle = 0.5 * (begin + end)
    i = law_piece(law, middle)
    best = -1.0
    for k in range(i, i + 2):
        instant = law[k, TIME]
        if begin < instant < end and (best < 0.0 or abs(instant - middle) < abs(best - middle)):
            best = instant
    return middle if best < 0.0 else best


@inner
def _append(strides: Floats, count: int, row: Floats) -> Floats:
    if count == strides.shape[0]:
        strides = sized_floats(strides, count, 2 * count)
    for column in range(STRIDE_COLUMNS):
        strides[count, column] = row[column]
    return strides


@inner
def _stand(path: TimedPath, begin: float, end: float, row: Floats) -> None:
    """A stride in which the robot stands."""
    row[U0], row[X0], row[Y0] = place_at(path, begin)
    row[U1], row[X1], row[Y1] = row[U0], row[X0], row[Y0]
    row[BEGIN], row[END], row[SAG] = begin, end, 0.0


@inner
def halve_stride(path: TimedPath, bends: Floats, strides: Floats, k: int) -> None:
    """Replace stride k by its later half, its earlier one after it."""
    late = strides[k]
    early = strides[k + 1]
    middle = halving_instant(path.law, late[BEGIN], late[END])
    u, x, y = place_at(path, middle)
    early[BEGIN], early[X0], early[Y0], early[U0] = late[BEGIN], late[X0], late[Y0], late[U0]
    early[END], early[X1], early[Y1], early[U1] = middle, x, y, u
    late[BEGIN], late[X0], late[Y0], late[U0] = middle, x, y, u
    early[SAG] = sag(path, bends, early[BEGIN], middle, early[U0], u)
    late[SAG] = sag(path, bends, middle, late[END], u, late[U1])


@inner
def strides_of(path: TimedPath, bends: Floats, hold: float, most: float) -> tuple[Floats, int]:
    """A drive in strides, and the robot standing at its end.

    Args:
        path: TimedPath.
        bends: See ``bends_of``.
        hold: How long it stands there [s].
        most: The largest sag [m].

    Returns:
        (strides (n, STRIDE_COLUMNS), count): in the order of time; the rows beyond are room.
    """
    law = path.law
    start = law[0, TIME]
    end = law[law.shape[0] - 1, TIME]
    stack = new_floats(MAX_STACK, STRIDE_COLUMNS)
    strides = new_floats(64, STRIDE_COLUMNS)
    count = 0
    first = stack[0]
    _stand(path, start, end, first)
    if end > start:
        first[U1], first[X1], first[Y1] = place_at(path, end)
        first[SAG] = sag(path, bends, start, end, first[U0], first[U1])
    top = 0
    while top >= 0:
        row = stack[top]
        small = row[END] - row[BEGIN] <= SHORTEST_S
        if row[SAG] <= most or small or top + 2 > MAX_STACK:
            strides = _append(strides, count, row)
            count += 1
            top -= 1
        else:
            halve_stride(path, bends, stack, top)
            top += 1
    if hold > 0.0:
        _stand(path, end, end + hold, stack[0])
        strides = _append(strides, count, stack[0])
        count += 1
    return strides, count
