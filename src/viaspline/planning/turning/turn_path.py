"""Lines and turns with ramps round a row of bends.

Tested through ``planning/methods/test_ordered``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.turning.heading_costs import lesser_side
from viaspline.kernels.turning.needed_turns import needed_turns
from viaspline.kernels.turning.settled_lines import FINE
from viaspline.kernels.turning.turn_spans import turn_sequence_length, turn_sequence_spans
from viaspline.planning.turning.bend_row import DETOUR, HEADING, SIDE, Bends, X, Y

OVERSHOOT = 1.0035  # of the least radius over the turning circle: cubics bend a little more
RAMP = 1.0  # length of a ramp, in radii
WOUND_RAD = 1.1 * math.pi  # a turn by more goes the longer way round
BACK_RAD = 2.5  # a turn by more goes to the other side as well, where there is no room
EXACTLY_BACK_RAD = 3.1  # a turn by more goes to either side alike
MOST_BACK = 2  # of such turns of a row, whose other sides are tried


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

    @property
    def largest_turn(self) -> float:
        """To either side [rad]."""
        return float(np.abs(self.turns).max(initial=0.0))

    def vias_about(self, u: float) -> frozenset[int]:
        """The via point that is next to a parameter of the curve, if a bend that is one is.

        Of others those about its line: see ``Bends.vias_about``.
        """
        line = int(np.searchsorted(self.begins[: len(self.left)], u, side="right")) - 1
        first, last = self.begins[line], self.begins[(line + 1) % len(self.begins)]
        along = np.hypot(*(self.spans[first:last, 3] - self.spans[first:last, 0]).T)
        before = float(along[: int(u) - first].sum()) < 0.5 * float(along.sum())
        return self.bends.vias_at(line if before else line + 1) or self.bends.vias_about(line)


@dataclass(frozen=True, eq=False)
class SettledTurns:
    """Where the lines and turns round a row of bends lie.

    Attributes:
        bends: The row, without those that the others make needless.
        left: Which of those that were asked for they are, (n,).
        lines_and_turns: See ``kernels.turning.turn_sequence``.
    """

    bends: Bends
    left: Ints
    lines_and_turns: tuple[Floats, ...]

    @property
    def turns(self) -> Floats:
        """By how much it turns at each bend, left is positive [rad], (n,)."""
        return self.lines_and_turns[1]


@dataclass(frozen=True)
class NoTurnPath:
    """Why there is none.

    Attributes:
        bends: The row, without those that the others make needless.
        left: Which of those that were asked for they are, (n,).
        state: One of the states of ``kernels.turning.settled_lines``.
        lines: Those at which it failed, (k,).
    """

    bends: Bends
    left: Ints
    state: int
    lines: Ints


def turn_path_round(bends: Bends) -> TurnPath | NoTurnPath:
    """The shortest turn path round a row of bends, to whichever sides given headings are left.

    A detour bend that the others make needless is left out.

    Args:
        bends: The row.
    """
    best: SettledTurns | NoTurnPath | None = None
    least = math.inf
    for tried in with_sides(bends):
        found = settled_turns(tried)
        length = math.inf if isinstance(found, NoTurnPath) else _length(found)
        if best is None or length < least:
            best, least = found, length
    assert best is not None  # there is always one choice of sides
    return best if isinstance(best, NoTurnPath) else _so_long(best, least)


def turn_path_on_sides(bends: Bends, ramp: float = RAMP) -> TurnPath | NoTurnPath:
    """The turn path round a row of bends, to the sides that are set.

    Args:
        bends: The row.
        ramp: Length of the ramps, in radii.
    """
    found = settled_turns(bends, ramp)
    return found if isinstance(found, NoTurnPath) else laid_turns(found)


def _length(settled: SettledTurns) -> float:
    """[m]."""
    bends = settled.bends
    return float(turn_sequence_length(bends.rows, bends.closed, *settled.lines_and_turns))


def laid_turns(settled: SettledTurns) -> TurnPath:
    """Lines and turns as a curve."""
    return _so_long(settled, _length(settled))


def _so_long(settled: SettledTurns, length: float) -> TurnPath:
    """Lines and turns as a curve that is so long [m]."""
    bends = settled.bends
    spans, begins = turn_sequence_spans(bends.rows, bends.closed, *settled.lines_and_turns)
    return TurnPath(bends, settled.left, spans, begins, settled.turns, length)


def settled_turns(bends: Bends, ramp: float = RAMP) -> SettledTurns | NoTurnPath:
    """The lines and turns round a row of bends, to the sides that are set.

    Args:
        bends: The row.
        ramp: Length of the ramps, in radii.
    """
    left, *lines_and_turns, state, tight = needed_turns(bends.rows, bends.closed, ramp)
    bends = bends.only(left)
    if state != FINE:
        return NoTurnPath(bends, left, int(state), tight)
    return SettledTurns(bends, left, tuple(lines_and_turns))


def with_sides(bends: Bends) -> Iterator[Bends]:
    """Every choice of the turns by which given headings at the ends are left: two for each.

    One is the lesser turn, to whichever side it comes to be: where the heading is nearly that of
    its line, that is known only once the turns have settled. The other one goes to the other side.
    At via points at which the path goes back as it came neither side is the lesser one: it goes to
    either, and to whichever it comes to be, which may settle otherwise.
    """
    ends = [(k, (0.0, -lesser_side(bends.rows, k == 0))) for k in _given(bends)]
    back = [(k, (0.0, side, -side)) for k, side in _turned_back(bends, EXACTLY_BACK_RAD)]
    if not ends and not back:
        yield bends
        return
    for sides in product(*(each for _, each in (*ends, *back))):
        rows = bends.rows.copy()
        for (k, _), side in zip((*ends, *back), sides, strict=True):
            rows[k, SIDE] = side
        set_ones = [k for k, _ in back if rows[k, SIDE] != 0.0]
        rows[set_ones, HEADING] = 0.0  # between others it says that a side is set
        yield Bends(rows, bends.vias, bends.swings, bends.closed)


def count_of_sides(bends: Bends) -> int:
    """How many choices ``with_sides`` has."""
    back: int = 3 ** len(_turned_back(bends, EXACTLY_BACK_RAD))
    return back << len(_given(bends))


def turned_otherwise(bends: Bends, turn_path: TurnPath | None) -> Iterator[Bends]:
    """The row with one of its via points turned at to the other side.

    Args:
        bends: The row.
        turn_path: What was laid round it: those are turned otherwise that it turns at the longer
            way round. None: there is no room, and those at which the path all but turns back.
    """
    if turn_path is None:
        found = _turned_back(bends, BACK_RAD)
    else:
        vias, turns = turn_path.bends.vias, turn_path.turns
        wound = (vias != DETOUR) & np.isnan(turn_path.bends.rows[:, HEADING])
        wound &= np.abs(turns) > WOUND_RAD
        sides = zip(vias[wound].tolist(), np.sign(turns[wound]).tolist(), strict=True)
        found = [(bends.places(via), side) for via, side in sides]
    for k, side in found:
        rows = bends.rows.copy()
        rows[k, SIDE], rows[k, HEADING] = -side, 0.0
        yield Bends(rows, bends.vias, bends.swings, bends.closed)


def _turned_back(bends: Bends, least: float) -> list[tuple[int, float]]:
    """Via points at which lines between middles turn by at least so much [rad], and to which side.

    Where a side is set already they are left out. They are few, for all choices are laid.
    """
    rows = bends.rows
    middles = np.vstack((rows[-1:], rows, rows[:1]))[:, [X, Y]]
    lines = np.arctan2(*np.diff(middles, axis=0).T[::-1])
    turns = np.remainder(np.diff(lines) + math.pi, math.tau) - math.pi
    free = (bends.vias != DETOUR) & np.isnan(rows[:, HEADING]) & (np.abs(turns) > least)
    if not bends.closed:
        free[[0, -1]] = False
    found = np.flatnonzero(free)
    furthest = found[np.argsort(-np.abs(turns[found]).round(6), kind="stable")][:MOST_BACK]
    return [(k, math.copysign(1.0, turns[k])) for k in sorted(furthest.tolist())]


def _given(bends: Bends) -> list[int]:
    """The ends at which headings are given, 0 the start and -1 the goal."""
    if bends.closed:
        return []
    return [k for k in (0, -1) if math.isfinite(bends.rows[k, HEADING])]
