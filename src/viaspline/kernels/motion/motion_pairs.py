"""Pairs of a stride of a robot and a piece of an obstacle's motion, bounded from both sides.

Tested through ``trajectory/test_moving_certificate``.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.growable import new_floats, sized_floats
from viaspline.kernels.jit import inlined, inner
from viaspline.kernels.motion.moving_distance import piece_at, uncertainty
from viaspline.kernels.motion.moving_gap import circle_gap, gap_bounds
from viaspline.kernels.motion.packed_motion import BEGINS, PackedMotion
from viaspline.kernels.motion.path_bends import sag
from viaspline.kernels.motion.strides import (
    BEGIN,
    END,
    SAG,
    STRIDE_COLUMNS,
    U0,
    U1,
    X0,
    X1,
    Y0,
    Y1,
    halving_instant,
)
from viaspline.kernels.motion.timed_path import TimedPath, place_at

# A pair is a part of a stride, whose parameters are nan where its end is on the straight line only,
OBSTACLE: Final = STRIDE_COLUMNS  # and besides the obstacle,
PIECE: Final = STRIDE_COLUMNS + 1  # its piece of motion, and when that has its time 0 [s],
SHIFT: Final = STRIDE_COLUMNS + 2
LOWER: Final = STRIDE_COLUMNS + 3  # and bounds of the distance [m],
UPPER: Final = STRIDE_COLUMNS + 4
FACING: Final = STRIDE_COLUMNS + 5  # and for a body its heading where the upper one is reached
REACHED: Final = STRIDE_COLUMNS + 6  # [rad], and when that is [s].
PAIR_COLUMNS: Final = STRIDE_COLUMNS + 7

SPARE_ROWS: Final = 2  # at the head of a table of pairs
FIRST_ROWS = 64


@inner
def bound_pair(motion: PackedMotion, pair: Floats, enough: float) -> None:
    """Fill in the bounds of a pair; see ``gap_bounds``."""
    pair[LOWER], pair[UPPER] = gap_bounds(
        motion, int(pair[OBSTACLE]), int(pair[PIECE]), pair[SHIFT], pair[BEGIN], pair[END],
        pair[X0], pair[Y0], pair[X1], pair[Y1], pair[SAG], enough,
    )  # fmt: skip


@inner
def copy_pair(pairs: Floats, source: int, target: int) -> None:
    """Put one row in the place of another."""
    for column in range(PAIR_COLUMNS):
        pairs[target, column] = pairs[source, column]


@inlined
def is_rough(pair: Floats) -> bool:
    """Whether an end of a pair is only known to be near the straight line."""
    return np.isnan(pair[U0]) or np.isnan(pair[U1])


@inner
def place_ends(path: TimedPath, bends: Floats, pair: Floats) -> None:
    """Put the ends of a pair where the robot is then; it isn't bounded anew."""
    pair[U0], pair[X0], pair[Y0] = place_at(path, pair[BEGIN])
    pair[U1], pair[X1], pair[Y1] = place_at(path, pair[END])
    pair[SAG] = sag(path, bends, pair[BEGIN], pair[END], pair[U0], pair[U1])


@inner
def halve_pair(path: TimedPath, bends: Floats, pairs: Floats, k: int, other: int) -> None:
    """Replace pair k by its later half, its earlier one in row ``other``; neither is bounded."""
    late = pairs[k]
    copy_pair(pairs, k, other)
    early = pairs[other]
    middle = halving_instant(path.law, late[BEGIN], late[END])
    u, x, y = place_at(path, middle)
    late[BEGIN], late[U0], late[X0], late[Y0] = middle, u, x, y
    early[END], early[U1], early[X1], early[Y1] = middle, u, x, y
    late[SAG] = sag(path, bends, middle, late[END], u, late[U1])
    early[SAG] = sag(path, bends, early[BEGIN], middle, early[U0], u)


@inlined
def next_piece(motion: PackedMotion, i: int, row: int, shift: float) -> tuple[int, float, float]:
    """The piece of obstacle i after a piece; see ``piece_at``."""
    period = motion.rounds[i, 1]
    row += 1
    if row == motion.first_piece[i + 1]:
        row = motion.first_piece[i]
        shift = (np.floor(shift / period + 0.5) + 1.0) * period
    if row + 1 < motion.first_piece[i + 1]:
        return row, shift, motion.pieces[row + 1, BEGINS] + shift
    return row, shift, motion.rounds[i, 0] + period + shift if period > 0.0 else np.inf


@inlined
def on_line(stride: Floats, axis: int, instant: float) -> float:
    """A coordinate on the straight line of a stride at an instant [m]; the axis is X0 or Y0."""
    lasts = stride[END] - stride[BEGIN]
    w = (instant - stride[BEGIN]) / lasts if lasts > 0.0 else 0.0
    return stride[axis] + w * (stride[axis + X1 - X0] - stride[axis])


@inner
def _add_pair(
    motion: PackedMotion, pair: Floats, stride: Floats, begin: float, end: float, enough: float,
    i: int, row: int, shift: float,
) -> None:  # fmt: skip
    """Fill in a pair of a part of a stride and a piece of motion."""
    pair[BEGIN], pair[X0], pair[Y0] = begin, on_line(stride, X0, begin), on_line(stride, Y0, begin)
    pair[END], pair[X1], pair[Y1] = end, on_line(stride, X0, end), on_line(stride, Y0, end)
    pair[U0] = stride[U0] if begin == stride[BEGIN] else np.nan
    pair[U1] = stride[U1] if end == stride[END] else np.nan
    pair[SAG] = stride[SAG]
    pair[OBSTACLE], pair[PIECE], pair[SHIFT], pair[FACING] = i, row, shift, np.nan
    pair[REACHED] = begin
    bound_pair(motion, pair, enough)


@inner
def pairs_of(
    motion: PackedMotion, strides: Floats, count: int, reach: float, enough: float
) -> tuple[Floats, int, float, int]:
    """All pairs that may hold the least distance, and those that may come too near.

    Args:
        motion: PackedMotion.
        strides: See ``strides_of``.
        count: How many of their rows count.
        reach: From the robot's reference point to what is farthest on its body [m].
        enough: Pairs whose body may come nearer than this are kept, too [m].

    Returns:
        (pairs (n, PAIR_COLUMNS), size, lower, best): rows from SPARE_ROWS on up to ``size`` are
        pairs, by obstacles and in the order of time; a lower bound of all others [m]; the row with
        the least upper bound, -1 if there is none. Distances are the reference point's.
    """
    pairs = new_floats(FIRST_ROWS, PAIR_COLUMNS)
    size = SPARE_ROWS
    lower = np.inf
    upper = np.inf
    best = -1
    for i in range(motion.first_piece.size - 1):
        begin = strides[0, BEGIN]
        row, shift, until = piece_at(motion, i, begin)
        k = 0
        while k < count:
            stride = strides[k]
            end = min(until, stride[END])
            circle = circle_gap(
                motion, i, row, shift, begin, end, on_line(stride, X0, begin),
                on_line(stride, Y0, begin), on_line(stride, X0, end), on_line(stride, Y0, end),
            )  # fmt: skip
            outside = circle - stride[SAG] - uncertainty(motion, i, end)
            beyond = max(upper, enough) + reach
            if outside >= beyond:
                lower = min(lower, outside)
            else:
                _add_pair(motion, pairs[size], stride, begin, end, beyond, i, row, shift)
                if reach > 0.0:  # how deep a body overlaps something isn't told
                    pairs[size, UPPER] = max(pairs[size, UPPER], -uncertainty(motion, i, begin))
                if pairs[size, UPPER] < upper:
                    upper, best = pairs[size, UPPER], size
                size += 1
                if size == pairs.shape[0]:
                    pairs = sized_floats(pairs, size, 2 * size)
            if end == stride[END]:
                k += 1
            if end == until:
                row, shift, until = next_piece(motion, i, row, shift)
            begin = end
    return pairs, size, lower, best
