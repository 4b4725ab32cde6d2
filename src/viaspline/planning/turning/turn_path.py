"""Lines and turns with ramps round a row of bends.

Tested through ``planning/methods/test_ordered``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import product

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.turning.turn_sequence import (
    FINE,
    LEFT_OUT,
    turn_sequence,
    turn_sequence_length,
    turn_sequence_spans,
)
from viaspline.planning.turning.bend_row import HEADING, SIDE, Bends

OVERSHOOT = 1.0035  # of the least radius over the turning circle: cubics bend a little more
RAMP = 1.0  # length of a ramp, in radii


@dataclass(frozen=True, eq=False)
class TurnPath:
    """A curve round a row of bends.

    Attributes:
        bends: The row, without those that the others make needless.
        left: Which of those that were asked for they are, (n,).
        spans: Bézier control polygons [m], shape (m, 4, 2); curvature is continuous.
        begins: The span that begins at the apex of each bend, (n,), (n + 1,) when closed; at the
            goal and where a closed curve ends it is m.
        turns: By how much it turns at each bend, left is positive [rad], (n,).
        length: [m].
    """

    bends: Bends
    left: Ints
    spans: Floats
    begins: NDArray[np.int64]
    turns: Floats
    length: float


@dataclass(frozen=True)
class NoTurnPath:
    """Why there is none.

    Attributes:
        bends: The row, without those that the others make needless.
        left: Which of those that were asked for they are, (n,).
        state: One of the states of ``kernels.turning.turn_sequence``.
        where: The line or the bend at which it failed, -1 where it can't be said.
    """

    bends: Bends
    left: Ints
    state: int
    where: int


def turn_path_round(bends: Bends) -> TurnPath | NoTurnPath:
    """The shortest turn path round a row of bends, to whichever sides given headings are left.

    A detour bend that the others make needless is left out.

    Args:
        bends: The row.
    """
    best: TurnPath | NoTurnPath | None = None
    for tried in with_sides(bends):
        found = turn_path_on_sides(tried)
        if best is None or (isinstance(found, TurnPath) and _is_longer(best, found)):
            best = found
    assert best is not None  # there is always one choice of sides
    return best


def _is_longer(turn_sequence: TurnPath | NoTurnPath, other: TurnPath) -> bool:
    return isinstance(turn_sequence, NoTurnPath) or turn_sequence.length > other.length


def turn_path_on_sides(bends: Bends, ramp: float = RAMP) -> TurnPath | NoTurnPath:
    """The turn path round a row of bends, to the sides that are set.

    Args:
        bends: The row.
        ramp: Length of the ramps, in radii.
    """
    left = np.arange(len(bends.rows))
    while True:
        lines, turns, apexes, ramps, state, where = turn_sequence(bends.rows, bends.closed, ramp)
        if state != LEFT_OUT:
            break
        bends, left = bends.without(where), np.delete(left, where)
    if state != FINE:
        return NoTurnPath(bends, left, int(state), int(where))
    spline_path = (bends.rows, bends.closed, lines, turns, apexes, ramps)
    spans, begins = turn_sequence_spans(*spline_path)
    return TurnPath(bends, left, spans, begins, turns, float(turn_sequence_length(*spline_path)))


def with_sides(bends: Bends) -> Iterator[Bends]:
    """Every choice of the sides to which given headings at the ends are left."""
    ends = [k for k in (0, -1) if not bends.closed and not math.isnan(bends.rows[k, HEADING])]
    for sides in product((1.0, -1.0), repeat=len(ends)):
        rows = bends.rows.copy()
        for k, side in zip(ends, sides, strict=True):
            rows[k, SIDE] = side
        yield replace(bends, rows=rows)
