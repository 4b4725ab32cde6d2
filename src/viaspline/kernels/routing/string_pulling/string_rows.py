"""The rows of a string: the features that it goes round, and its two ends.

Tested through ``kernels/routing/string_pulling/test_pull``.
"""

from __future__ import annotations

from viaspline.kernels.arrays import Floats
from viaspline.kernels.growable import sized_floats
from viaspline.kernels.jit import inlined, inner
from viaspline.kernels.routing.tangent_arcs import (
    BEND_RADIUS,
    BEND_X,
    BEND_Y,
    HEADING_IN,
    SIDE,
    TURN,
)
from viaspline.kernels.world.ring_features import FEATURE_RADIUS, FEATURE_X, FEATURE_Y

# a string's row is a bend and where its feature lies along the guide
PLACE = 6
ROW_COLUMNS = 7


@inner
def insert(rows: Floats, count: int, at: int) -> Floats:
    """Make room for one more row at ``at``."""
    if count == rows.shape[0]:
        rows = sized_floats(rows, count, 2 * count)
    for i in range(count, at, -1):
        for k in range(ROW_COLUMNS):
            rows[i, k] = rows[i - 1, k]
    return rows


@inlined
def remove(rows: Floats, count: int, at: int) -> int:
    """Take out the row at ``at``; how many are left."""
    for i in range(at, count - 1):
        for k in range(ROW_COLUMNS):
            rows[i, k] = rows[i + 1, k]
    return count - 1


@inlined
def write_end(rows: Floats, k: int, guide: Floats, corner: int) -> None:
    """Write an end of the guide to row k."""
    for column in range(ROW_COLUMNS):
        rows[k, column] = 0.0
    rows[k, BEND_X] = guide[corner, 0]
    rows[k, BEND_Y] = guide[corner, 1]
    rows[k, PLACE] = corner


@inlined
def write(
    rows: Floats, k: int, found: Floats, j: int, rho: float, side: float, place: float
) -> None:
    """Write feature j to row k."""
    rows[k, BEND_X] = found[j, FEATURE_X]
    rows[k, BEND_Y] = found[j, FEATURE_Y]
    rows[k, BEND_RADIUS] = found[j, FEATURE_RADIUS] + rho
    rows[k, SIDE] = side
    rows[k, HEADING_IN] = 0.0
    rows[k, TURN] = 0.0
    rows[k, PLACE] = place


@inlined
def is_row(rows: Floats, k: int, found: Floats, j: int, side: float) -> bool:
    """Whether row k goes round feature j on this side."""
    return (
        rows[k, BEND_X] == found[j, FEATURE_X]
        and rows[k, BEND_Y] == found[j, FEATURE_Y]
        and rows[k, SIDE] == side
    )
