"""Where a true motion rolls back a little, as speeds that are off let a robot do that stands."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats

FORWARDS: Final = math.cos(0.3)
"""A way that is so near to the headings at both of its ends leads forwards."""


def without_rolling_back(positions: Floats, headings: Floats) -> tuple[Floats, float]:
    """The places of a motion that only goes forwards: it stands where the true one rolls back.

    From where it begins to roll back it stands, until the true one has come past that place.

    Args:
        positions: [m], shape (n, 2).
        headings: Of the body [rad], shape (n,).

    Returns:
        The places, shape (n, 2), and how far they are from the true ones at most [m].

    Example:
        >>> there_and_back = np.array([[0.0, 0.0], [2.0, 0.0], [1.9, 0.0], [1.95, 0.0], [2.2, 0.0]])
        >>> places, off = without_rolling_back(there_and_back, np.zeros(5))
        >>> places[:, 0].tolist(), round(off, 3)
        ([0.0, 2.0, 2.0, 2.0, 2.2], 0.1)
    """
    ahead = np.column_stack((np.cos(headings), np.sin(headings)))
    along = (np.diff(positions, axis=0) * (ahead[:-1] + ahead[1:])).sum(axis=1)
    places, off, row = positions.copy(), 0.0, 0
    for first in np.flatnonzero(along < 0.0).tolist():
        if first < row:
            continue  # it stands there already
        row = _past(positions, ahead, first)
        away = np.linalg.norm(positions[first:row] - positions[first], axis=1)
        off = max(off, float(away.max()))
        places[first:row] = positions[first]
    return places, off


def _past(positions: Floats, ahead: Floats, first: int) -> int:
    """The first row that lies ahead of one; as many as there are, if none does.

    Ahead by the headings with which the body leaves that place and comes to the row: standing
    there, it may have turned on the spot.
    """
    ways = positions[first + 1 :] - positions[first]
    least = FORWARDS * np.linalg.norm(ways, axis=1)
    leaves, comes = ahead[first:-1], ahead[first + 1 :]
    is_ahead = ((ways * leaves).sum(axis=1) >= least) & ((ways * comes).sum(axis=1) >= least)
    is_ahead &= least > 0.0
    return first + 1 + int(np.argmax(is_ahead)) if is_ahead.any() else len(positions)
