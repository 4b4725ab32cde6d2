"""Where a true motion stands and turns on the spot: poses that its curve doesn't have.

At a corner a curve turns from the heading with which the body came to the one with which it goes,
by the lesser turn. A true one may turn beyond either, or have turned before it first moved.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.machine.rolling_back import without_rolling_back

STANDING_M: Final = 1e-9
"""A body that moves less than this from one row to the next stands [m]."""


def turned_in_place(
    positions: Floats, headings: Floats, spacing: float
) -> tuple[Ints, Floats, float]:
    """The poses of a body where it stands, closely spaced.

    Args:
        positions: Of a motion, row by row [m], shape (n, 2).
        headings: Of the body, running on over whole turns [rad], shape (n,).
        spacing: Of the headings of one place, at most [rad].

    Returns:
        The row of a pose's place and its heading [rad], both (k,); and how far the body's place is
        from that of the pose with the nearest heading, at most [m].

    Example:
        >>> places = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
        >>> rows, facing, off = turned_in_place(places, np.array([0.0, 0.0, 1.5, 1.5]), 0.5)
        >>> rows.tolist(), facing.tolist(), off
        ([1, 1, 1, 1], [0.0, 0.5, 1.0, 1.5], 0.0)
    """
    held, off = without_rolling_back(positions, headings)
    rows, facing = [np.empty(0, np.int64)], [np.empty(0)]
    for first, last in _stands(held):
        seen = headings[first : last + 1]
        turned = np.concatenate(([0.0], np.cumsum(np.abs(np.diff(seen)))))
        count = int(np.ceil(turned[-1] / spacing)) + 1
        away = np.linalg.norm(positions[first : last + 1] - positions[first], axis=1)
        off = max(off, float(away.max()))
        rows.append(np.full(count, first))
        facing.append(np.interp(np.linspace(0.0, turned[-1], count), turned, seen))
    return np.concatenate(rows), np.concatenate(facing), off


def _stands(places: Floats) -> Iterator[tuple[int, int]]:
    """The first and the last row of each time for which it stands."""
    steps = np.hypot(*np.diff(places, axis=0).T)
    moves = np.concatenate(([True], steps > STANDING_M, [True]))
    edges = np.flatnonzero(np.diff(moves.astype(np.int64))).tolist()
    yield from zip(edges[::2], edges[1::2], strict=True)
