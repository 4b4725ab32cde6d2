"""What the stretches of a motion ask for, by the coefficients of v² that each of them knows.

A stretch knows its own middle Bernstein coefficient, the one before it and the one after it.

Tested through ``trajectory/test_jerk``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.trajectory.motion_ends import Even, Moving, Rest, Rows, Seam


def joined_ends(
    widths: Floats, h: Floats, start: Rest | Moving | Seam, end: Rest | Even | Seam
) -> Floats:
    """a0, a1, w0, m, w1 of stretches by the coefficients they know, shape (n, 5, 3)."""
    ends = np.zeros((h.size, 5, 3))
    ends[:, 3, 1] = 1.0
    both = h[:-1] + h[1:]
    ends[1:, 0, 0], ends[1:, 0, 1] = -1.0 / both, 1.0 / both
    ends[1:, 2, 0], ends[1:, 2, 1] = h[1:] / both, h[:-1] / both
    ends[:-1, 1, 1:], ends[:-1, 4, 1:] = ends[1:, 0, :2], ends[1:, 2, :2]
    if isinstance(start, Rest):
        rest = 1.5 * widths[0]
        ends[0, 0, 1], ends[0, 2, 1] = 1.0 / (rest + h[0]), rest / (rest + h[0])
    else:
        before = widths[0] if isinstance(start, Moving) else h[-1]
        whole = before + h[0]
        ends[0, 0, :2] = -1.0 / whole, 1.0 / whole
        ends[0, 2, :2] = h[0] / whole, before / whole
    if isinstance(end, Rest):
        rest = 1.5 * widths[-1]
        ends[-1, 1, 1], ends[-1, 4, 1] = -1.0 / (rest + h[-1]), rest / (rest + h[-1])
    elif isinstance(end, Even):
        ends[-1, 4, 1] = 1.0
    else:
        ends[-1, 1, 1:], ends[-1, 4, 1:] = ends[0, 0, :2], ends[0, 2, :2]
    return ends


def joined_rows(
    widths: Floats, rows: Rows, jerk: float, ends: Floats, start: Rest | Moving | Seam,
    end: Rest | Even | Seam, inner: slice,
) -> tuple[Floats, Floats, Ints]:  # fmt: skip
    """All rows that ask for something, with right-hand sides, and where each stretch's begin."""
    inside = np.einsum("nkz,nzc->nkc", rows.weights[inner], ends)
    more, bound = _outer_rows(widths, rows, jerk, ends, start, end)
    limits = np.concatenate((rows.limits[inner], bound), axis=1)
    asks = limits < np.inf
    first = np.concatenate(([0], np.cumsum(asks.sum(axis=1))))
    return np.concatenate((inside, more), axis=1)[asks], limits[asks], first


def _outer_rows(
    widths: Floats, rows: Rows, jerk: float, ends: Floats, start: Rest | Moving | Seam,
    end: Rest | Even | Seam,
) -> tuple[Floats, Floats]:  # fmt: skip
    """What the stretches beside the ends ask of their neighbours, with right-hand sides."""
    n, many = ends.shape[0], rows.limits.shape[1]
    more = np.zeros((n, 3 + 2 * many, 3))
    bound = np.full(more.shape[:2], np.inf)
    more[:, 0, 1], bound[:, 0] = -1.0, 0.0
    beside = [(0, 0, 0)] if isinstance(start, Rest) else []
    beside += [(-1, -1, 1)] if isinstance(end, Rest) else []
    for inner, outer, at in beside:
        k = slice(3 + at * many, 3 + (at + 1) * many)
        moving = np.zeros((5, 3))
        moving[1 - at], moving[2 if at else 4] = ends[inner, at], ends[inner, 4 if at else 2]
        more[inner, k], bound[inner, k] = rows.weights[outer] @ moving, rows.limits[outer]
        more[inner, 1] = ends[inner, 4 if at else 2]
        bound[inner, 1] = (4.5 * widths[outer] ** 2 * jerk) ** (2.0 / 3.0)
    if isinstance(start, Moving):
        k, first = slice(3, 3 + many), widths[0]
        moving = np.zeros((5, 3))
        moving[1], moving[4] = ends[0, 0], ends[0, 2]
        middle = start.square + start.accel * first
        given = rows.weights[0] @ np.array([start.accel, 0.0, start.square, middle, 0.0])
        free = np.any(rows.weights[0][:, [1, 4]] != 0.0, axis=1)
        more[0, k] = rows.weights[0] @ moving
        bound[0, k] = np.where(free, rows.limits[0] - given, np.inf)
        rise = start.accel + 1.5 * jerk * first / np.sqrt(start.square)  # no stretch reaches it
        room = jerk * first / np.sqrt(max(start.square, middle, middle + rise * first))
        more[0, 1], bound[0, 1] = ends[0, 0], room + start.accel
        more[0, 2], bound[0, 2] = -ends[0, 0], room - start.accel
    return more, bound


def places_in_bands(near: Ints, order: Ints) -> tuple[Ints, int]:
    """Where the products of two coefficients go in the lower bands; the last place is for none."""
    n = order.size
    place = np.append(order, (-1, -1))[near]
    row, column = place[:, :, None], place[:, None, :]
    apart = row - column
    valid = (row >= 0) & (column >= 0) & (apart >= 0)
    bands = int(apart[valid].max()) + 1
    return np.where(valid, apart * n + column, bands * n), bands
