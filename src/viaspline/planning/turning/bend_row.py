"""A row of bends: the via points, and what the taut paths between them go round.

Tested through ``planning/methods/test_ordered``.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.routing.tangent_arcs import BEND_RADIUS, BEND_X, BEND_Y
from viaspline.kernels.routing.tangent_arcs import SIDE as BEND_SIDE
from viaspline.kernels.turning.settled_lines import HEADING, KEPT, RADIUS, SIDE, X, Y
from viaspline.kernels.world.corner_fans import X as CORNER_X
from viaspline.kernels.world.corner_fans import Y as CORNER_Y
from viaspline.planning.problem.via_sequence import ViaSequence
from viaspline.planning.routing.taut_path import TautPath

DETOUR = -1
TURNS_BACK = 1e-6  # length of the sum of two directions that are opposite but for rounding
_ROUND, _TAUT_ROUND = [X, Y, KEPT, SIDE], [BEND_X, BEND_Y, BEND_RADIUS, BEND_SIDE]


@dataclass(frozen=True)
class Bends:
    """Bends in the order of the path.

    Attributes:
        rows: See ``kernels.turning.settled_lines``, shape (n, 6).
        vias: Index of each one's via point in the sequence, or ``DETOUR``, shape (n,).
        swings: How far each one's turn may swing out beyond what is kept [m], (n,); infinite
            where it may be as wide as is fast, 0 at via points where the robot stands.
        closed: Whether the last one is followed by the first.
    """

    rows: Floats
    vias: NDArray[np.int64]
    swings: Floats
    closed: bool = False

    @classmethod
    def free(cls, rows: Floats, vias: NDArray[np.int64]) -> Bends:
        """Bends of an open row whose turns may be as wide as is fast."""
        return cls(rows, vias, np.full(len(rows), math.inf))

    @property
    def key(self) -> tuple[bytes, bytes, bytes, bool]:
        """What tells these bends from others."""
        return self.rows.tobytes(), self.vias.tobytes(), self.swings.tobytes(), self.closed

    def with_bend(self, k: int, row: Floats) -> Bends:
        """These bends with a detour bend before bend k."""
        return Bends(
            np.insert(self.rows, k, row, axis=0),
            np.insert(self.vias, k, DETOUR),
            np.insert(self.swings, k, math.inf),
            self.closed,
        )

    def without(self, needless: NDArray[np.intp]) -> Bends:
        """These bends without some of them."""
        rows, swings = np.delete(self.rows, needless, axis=0), np.delete(self.swings, needless)
        return Bends(rows, np.delete(self.vias, needless), swings, self.closed)

    def only(self, left: Ints) -> Bends:
        """Those of these bends, (k,), in their order."""
        if len(left) == len(self.rows):
            return self
        return Bends(self.rows[left], self.vias[left], self.swings[left], self.closed)

    def turning(self, radii: float | Floats) -> Bends:
        """These bends with other least radii of their turns: one [m], or one for each, (n,)."""
        rows = self.rows.copy()
        rows[:, RADIUS] = radii
        return Bends(rows, self.vias, self.swings, self.closed)

    def widened(self, k: int, by: float) -> Bends:
        """These bends with more room kept from what detour bend k goes round [m]."""
        rows = self.rows.copy()
        rows[k, KEPT] += by
        return replace(self, rows=rows)

    def leg_of(self, k: int) -> int:
        """The leg on which bend k lies; the last of the via points ends the last one."""
        vias = self.vias != DETOUR
        last = int(vias.sum()) - (1 if self.closed else 2)
        return min(int(vias[: k + 1].sum()) - 1, last)

    def vias_about(self, line: int) -> frozenset[int]:
        """The via points at the ends of a line, k from bend k on; those of its leg if none are."""
        return self.vias_at(line, line + 1) or self._ends_of_leg(line)

    def vias_of(self, row: int) -> frozenset[int]:
        """The via point that a bend is; those of its leg if it is none."""
        return self.vias_at(row) or self._ends_of_leg(row)

    def vias_at(self, *rows: int) -> frozenset[int]:
        """Those of some bends that are via points."""
        vias = (int(self.vias[row % len(self.rows)]) for row in rows)
        return frozenset(via for via in vias if via != DETOUR)

    def _ends_of_leg(self, row: int) -> frozenset[int]:
        """The via points before and after a bend."""
        at_vias = np.flatnonzero(self.vias != DETOUR)
        after = int(np.searchsorted(at_vias, row, side="right"))
        return self.vias_at(at_vias[after - 1], at_vias[after % len(at_vias)])

    def between(self, first: int, last: int) -> Bends:
        """Those from one via point to another, of a round past its end.

        From a via point to itself that is all of the round.
        """
        begin, end = self.places(first), self.places(last)
        count = end - begin if begin < end else end - begin + len(self.rows)
        rows = np.arange(begin, begin + count + 1) % len(self.rows)
        return Bends(self.rows[rows], self.vias[rows], self.swings[rows])

    def thinned(self, off: float) -> Bends:
        """These bends without detours that lie no farther than that off the line of others [m].

        So it is with corners of cells along a wall. A detour is between two others to its own side,
        of a row that is open; the one that lies least off its line goes first.
        """
        left = np.arange(len(self.rows))
        while len(left) > 4:
            offs = self._off_lines(left[1:-1])
            least = int(offs.argmin())
            if offs[least] > off:
                break
            left = np.delete(left, least + 2)
        return self.only(left)

    def _off_lines(self, left: Ints) -> Floats:
        """How far bends lie off the lines of those before and after them [m], (n - 2,).

        Infinite for those that stay.

        Args:
            left: Which bends there are, (n,).
        """
        before, at, after = left[:-2], left[1:-1], left[2:]
        places, sides, is_detour = self.rows[:, :2], self.rows[:, SIDE], self.vias == DETOUR
        way, own = places[after] - places[before], places[at] - places[before]
        lengths = np.hypot(*way.T)
        goes = is_detour[before] & is_detour[at] & is_detour[after] & (lengths > 0.0)
        goes &= (sides[before] == sides[at]) & (sides[at] == sides[after])
        offs = np.abs(way[:, 0] * own[:, 1] - way[:, 1] * own[:, 0])
        found = np.full(len(at), np.inf)
        found[goes] = offs[goes] / lengths[goes]
        return found

    def heading_through(self, k: int) -> float:
        """The heading that halves the turn at bend k, which goes round nothing [rad].

        Where the lines there and away lie on each other it is that of the line there.
        """
        there, away = self._lines_at(k)
        both = there + away
        x, y = (both if np.hypot(*both) > TURNS_BACK else there).tolist()
        return math.atan2(y, x)

    def turn_at(self, k: int) -> float:
        """By how much the lines there and away turn at bend k, which goes round nothing [rad]."""
        there, away = self._lines_at(k)
        return math.atan2(there[0] * away[1] - there[1] * away[0], float(there @ away))

    def _lines_at(self, k: int) -> tuple[Floats, Floats]:
        """The directions of the lines there and away at bend k, which goes round nothing, (2,)."""
        before, at, after = self.rows[np.arange(k - 1, k + 2) % len(self.rows)]
        return -_tangent(at, before, -1.0), _tangent(at, after, 1.0)

    def places(self, via: int) -> int:
        """Where in the row a via point of the sequence stands."""
        return int(np.flatnonzero(self.vias == via)[0])


def _tangent(at: Floats, row: Floats, way: float) -> Floats:
    """The direction from a place to where the circle of a row is touched, (2,).

    Args:
        at: A row that is the place.
        row: The other.
        way: 1 where the path goes there from the place, -1 where it comes from there.
    """
    off = row[:2] - at[:2]
    far = float(np.hypot(*off))
    if far == 0.0:
        return np.zeros(2)
    sin = -way * row[SIDE] * min(row[KEPT] / far, 1.0)
    cos = math.sqrt(1.0 - sin**2)
    x, y = (off / far).tolist()
    return np.array([cos * x - sin * y, sin * x + cos * y])


def _straight(count: int) -> Floats:
    """Rows of ``Bends`` that go round nothing at 0, 0, (n, 6)."""
    rows = np.zeros((count, 6))
    rows[:, HEADING] = math.nan
    return rows


def bend(x: float, y: float, kept: float = 0.0, side: float = 0.0, radius: float = 0.0) -> Floats:
    """A row of ``Bends``."""
    row = np.array([x, y, 0.0, 0.0, math.nan, 0.0])
    row[KEPT], row[SIDE], row[RADIUS] = kept, side, radius
    return row


@dataclass(frozen=True)
class LegBends:
    """The bends between two via points.

    Attributes:
        rows: As in ``Bends``, (k, 6).
        swings: The same, (k,).
        end_swing: The same of the via points before and after [m].
    """

    rows: Floats
    swings: Floats
    end_swing: float = math.inf

    @classmethod
    def along(cls, taut_path: TautPath) -> LegBends:
        """What a taut path goes round."""
        rows = rows_along(taut_path)
        return cls(rows, np.full(len(rows), math.inf))


RowBends = tuple[LegBends, ...]
"""Those of all legs of a row."""


def bends_along(sequence: ViaSequence, taut_paths: Sequence[TautPath]) -> Bends:
    """The bends of a via sequence whose legs go along taut paths."""
    return bends_of_legs(sequence, [LegBends.along(taut_path) for taut_path in taut_paths])


def bends_of_legs(sequence: ViaSequence, legs: Sequence[LegBends]) -> Bends:
    """The bends of a via sequence with those of its legs between them."""
    table = _straight(len(sequence.vias) + sum(len(leg.rows) for leg in legs))
    vias: list[int] = []
    swings: list[float] = []
    ends = [leg.end_swing for leg in legs]
    before = [*(ends[-1:] if sequence.closed else [math.inf]), *ends]
    after = [*ends, math.inf]
    for k, via in enumerate(sequence.vias):
        table[len(vias), :2] = via.at[:2]
        vias.append(k)
        is_passed = via.dwell <= 0.0 or (not sequence.closed and k in (0, len(legs)))
        swings.append(min(before[k], after[k]) if is_passed else 0.0)
        if k < len(legs):
            table[len(vias) : len(vias) + len(legs[k].rows)] = legs[k].rows
            vias += [DETOUR] * len(legs[k].rows)
            swings += legs[k].swings.tolist()
    if not sequence.closed:
        for k, tangent in ((0, sequence.start_tangent), (-1, sequence.end_tangent)):
            if tangent is not None:
                table[k, HEADING] = math.atan2(tangent[1], tangent[0])
    return Bends(table, np.array(vias), np.array(swings), sequence.closed)


def rows_along(taut_path: TautPath) -> Floats:
    """What a way goes round, (k, 6); where its arcs have no common tangents, its corners."""
    if len(taut_path.bends):
        rows = _straight(len(taut_path.bends) - 2)
        rows[:, _ROUND] = taut_path.bends[1:-1, _TAUT_ROUND]
        return rows
    corners = taut_path.corners[:, [CORNER_X, CORNER_Y]]
    steps = np.diff(corners, axis=0)
    turns = steps[:-1, 0] * steps[1:, 1] - steps[:-1, 1] * steps[1:, 0]
    rows = _straight(len(turns))
    rows[:, :2], rows[:, SIDE] = corners[1:-1], np.copysign(1.0, turns)
    return rows


__all__ = [
    "DETOUR", "HEADING", "KEPT", "RADIUS", "SIDE", "Bends", "LegBends", "RowBends", "X", "Y",
    "bend", "bends_along", "bends_of_legs", "rows_along",
]  # fmt: skip
