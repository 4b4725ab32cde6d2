"""Bends close behind each other that one turn goes round.

Where corners stand so close that a turn at each has no room to be wide, a good driver takes them
as one. Such bends become one that a circle about them is kept from: its turn touches the first and
the last of them. Two are joined at a time, those first by which the whole row bends less.

Tested through ``planning/turning/test_joined_bends``.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.turning.gentle_lengths import gentle_lengths
from viaspline.planning.turning.bend_row import DETOUR, KEPT, SIDE, Bends, X, Y

LEAST_GENTLER = 0.1  # of the bending of two turns, that one in their place saves at least
LEAST_LONGER = 1.2  # length of one turn, over the way from its first bend to its last
LEAST_WIDER = 1.01  # its radius over what is kept from any of them
SMALLER = 0.7  # a radius without room, over the next one
MAX_TURN_RAD = 2.5  # of one turn
LEAST_PART = 0.2  # of what the circle turns by on half of the way, that either turns by alone
LEAST_TURN_RAD = 1e-6  # of each that is joined
LEAST_LENGTH_M = 1e-9
CROWDED = 0.4  # of a line, that two turns take which may be one
REACH = 12  # turns before a join and after it, with which it is weighed at first


@dataclass(frozen=True)
class Join:
    """Bends of a row that one turn goes round.

    Attributes:
        first: The first of them.
        last: The last of them.
        radius: Of the circle that is kept from both [m].
        least: What the radius has to be, so that it is worth it [m].
        inner: Those of its bends that were joined before the others; None if there are none.
    """

    first: int
    last: int
    radius: float
    least: float
    inner: Join | None = None


@dataclass(frozen=True, eq=False)
class TurnWishes:
    """What the turns of a row of bends are to be like, if there is one at each.

    Attributes:
        turns: By how much the path turns, none negative [rad], (n,).
        gaps: The way from each to the next [m], (n - 1,), or (n,) when closed.
        lengths: [m], (n,).
        fast: The radius with which each is passed soonest [m], (n,).
        spent: By how much the path may be longer than its corners [m].
    """

    turns: Floats
    gaps: Floats
    lengths: Floats
    fast: Floats
    spent: float


@dataclass(frozen=True, eq=False)
class _Runs:
    """A row of bends, some of them joined: the turns that are left.

    Attributes:
        ends: The first and the last bend of each turn, (k, 2).
        turns: [rad], (k,).
        ways: From the first bend of each to its last [m], (k,).
        gaps: From the last bend of each to the first of the next [m], one for each line.
        lengths: [m], (k,).
        spent: By how much the path may be longer than its corners [m].
        joins: For each that is joined what it is, else None.
        closed: Whether the last is followed by the first.
    """

    ends: Ints
    turns: Floats
    ways: Floats
    gaps: Floats
    lengths: Floats
    spent: float
    joins: tuple[Join | None, ...]
    closed: bool

    @property
    def bending(self) -> Floats:
        """The squared curvature along each turn, ramps alone [1/m], (k,)."""
        found: Floats = 4.0 / 3.0 * self.turns**2 / np.maximum(self.lengths, LEAST_LENGTH_M)
        return found


def joins_worth_it(bends: Bends, wishes: TurnWishes, room_share: float) -> tuple[Join, ...]:
    """Bends of a row that one turn goes round more gently, each in one join at most.

    Args:
        bends: The row, without needless ones.
        wishes: Of their turns.
        room_share: Of the way between two turns, that they may take.
    """
    count = len(bends.rows)
    ends = np.repeat(np.arange(count), 2).reshape(-1, 2)
    runs = _Runs(
        ends, wishes.turns, np.zeros(count), wishes.gaps, wishes.lengths, wishes.spent,
        (None,) * count, bends.closed,
    )  # fmt: skip
    weighed: dict[int, float] = {}  # by the first bend of two turns: what is saved if they are one
    while True:
        crowded = {int(runs.ends[k, 0]): k for k in _crowded(runs, bends)}
        for first in crowded.keys() - weighed.keys():
            near, low = _near(runs, crowded[first])
            joined = _joined_at(crowded[first] - low, near, bends, wishes, room_share)
            weighed[first] = -math.inf if joined is None else joined[1]
        best = max(crowded, key=weighed.__getitem__, default=None)
        if best is None or weighed[best] == -math.inf:
            return tuple(join for join in runs.joins if join is not None)
        k = crowded[best]
        joined = _joined_at(k, runs, bends, wishes, room_share)
        if joined is None:
            weighed[best] = -math.inf
            continue
        runs = joined[0]
        for bend in runs.ends[max(k - REACH - 1, 0) : k + REACH + 2, 0].tolist():
            weighed.pop(bend, None)


def _near(runs: _Runs, k: int) -> tuple[_Runs, int]:
    """The turns about k and k + 1, and which is their first; all of a row that is hardly longer.

    They may lengthen the path by their part.
    """
    count = len(runs.turns)
    low, high = max(k - REACH, 0), min(k + 2 + REACH, count)
    if high - low == count:
        return runs, 0
    part = slice(low, high)
    longer = runs.turns**2 * runs.lengths
    share = float(longer[part].sum() / longer.sum())
    near = _Runs(
        runs.ends[part], runs.turns[part], runs.ways[part], runs.gaps[low : high - 1],
        runs.lengths[part], share * runs.spent, runs.joins[part], False,
    )  # fmt: skip
    return near, low


def _crowded(runs: _Runs, bends: Bends) -> Iterator[int]:
    """The turns that can be one with the next: to one side, free, with hardly a line between."""
    free = (bends.vias == DETOUR) & np.isinf(bends.swings)
    for k, ((_, before), (after, _)) in enumerate(pairwise(runs.ends.tolist())):
        is_alike = (
            free[before] and free[after] and bends.rows[before, SIDE] == bends.rows[after, SIDE]
        )
        turns = runs.turns[k : k + 2]
        if not is_alike or turns.min() <= LEAST_TURN_RAD or turns.sum() > MAX_TURN_RAD:
            continue
        if runs.lengths[k : k + 2].sum() >= CROWDED * 2.0 * runs.gaps[k]:
            yield k


def _joined_at(
    k: int, runs: _Runs, bends: Bends, wishes: TurnWishes, room_share: float
) -> tuple[_Runs, float] | None:
    """The row with turns k and k + 1 as one and what it bends less by [1/m], if it is worth it.

    The one turn, of length l, has its arc between its bends, a way d long, and ramps before and
    after it: its radius is (l + d) / 2 t. It is nearly as gentle as one of ramps alone, as long,
    in the middle of that way.
    """
    first, last = int(runs.ends[k, 0]), int(runs.ends[k + 1, 1])
    turn = float(runs.turns[k : k + 2].sum())
    way = float(runs.ways[k] + runs.gaps[k] + runs.ways[k + 1])
    turns, ways = _merged(runs.turns, k, turn), _merged(runs.ways, k, way)
    gaps = np.delete(runs.gaps, k)
    fast = turn * float(wishes.fast[first : last + 1].max())
    spent = runs.spent * float((turns**2).sum() / (runs.turns**2).sum())  # as much for each turn
    rooms = 2.0 * room_share * (gaps + 0.5 * (ways + np.roll(ways, -1))[: len(gaps)])
    lengths = gentle_lengths(turns, rooms, runs.closed, spent)
    lengths[k] = _no_shorter(lengths, rooms, k, fast)
    radius = 0.5 * (float(lengths[k]) + way) / turn
    kept = float(bends.rows[first : last + 1, KEPT].max())
    part = 0.5 * way / float(runs.turns[k : k + 2].min())
    least = max(way / turn, LEAST_WIDER * kept, LEAST_PART * part)
    if lengths[k] < LEAST_LONGER * way or radius < least:
        return None
    inner = next((join for join in runs.joins[k : k + 2] if join is not None), None)
    joins = (*runs.joins[:k], Join(first, last, radius, least, inner), *runs.joins[k + 2 :])
    ends = np.vstack((runs.ends[:k], [[first, last]], runs.ends[k + 2 :]))
    joined = _Runs(ends, turns, ways, gaps, lengths, spent, joins, runs.closed)
    saved = float(runs.bending.sum() - joined.bending.sum())
    return (joined, saved) if saved > LEAST_GENTLER * runs.bending[k : k + 2].sum() else None


def _no_shorter(lengths: Floats, rooms: Floats, k: int, wanted: float) -> float:
    """The length of turn k, at least what is wanted if the turns before and after it let it [m]."""
    after = np.roll(lengths, -1)[: len(rooms)]
    left = rooms - lengths[: len(rooms)] - after
    beside = left[[k - 1, k]] if len(left) == len(lengths) else left[max(k - 1, 0) : k + 1]
    return float(max(lengths[k], min(wanted, lengths[k] + beside.min(initial=wanted))))


def _merged(values: Floats, k: int, both: float) -> Floats:
    """Values with one in the place of k and k + 1."""
    found = np.delete(values, k + 1)
    found[k] = both
    return found


def with_joins(bends: Bends, joins: Collection[Join]) -> Bends:
    """A row with one bend for those of each join: the first of them is in its place.

    Args:
        bends: The row.
        joins: None of them with a bend of another.

    Example:
        >>> from viaspline.planning.turning.bend_row import bend
        >>> row = np.array([bend(-9, 0), bend(-3, 0, 1, -1), bend(3, 0, 1, -1), bend(9, 0)])
        >>> bends = Bends.free(row, np.array([0, DETOUR, DETOUR, 1]))
        >>> with_joins(bends, [Join(1, 2, 6.0, 3.0)]).rows[1, :4]
        array([ 0., -4.,  6., -1.])
    """
    rows = bends.rows.copy()
    for join in joins:
        first, last = bends.rows[[join.first, join.last]]
        rows[join.first, [X, Y]] = _middle(first, last, join.radius)
        rows[join.first, KEPT] = join.radius
    return replace(bends, rows=rows).without(rest_of(joins))


def rest_of(joins: Collection[Join]) -> Ints:
    """The bends of joins but for the first of each: they have no rows of their own, (k,)."""
    rest = [k for join in joins for k in range(join.first + 1, join.last + 1)]
    return np.array(rest, np.int64)


def loosened(joins: Collection[Join], tight: Collection[int]) -> Iterator[Join]:
    """The joins with smaller radii where there is no room; of those too small then, the inner ones.

    Args:
        joins: Those of a row.
        tight: Bends of the row where there is no room.
    """
    for join in joins:
        if join.first not in tight:
            yield join
        elif SMALLER * join.radius >= join.least:
            yield replace(join, radius=SMALLER * join.radius)
        elif join.inner is not None:
            yield join.inner


def _middle(first: Floats, second: Floats, radius: float) -> Floats:
    """The middle of the circle of a radius that touches what two bends go round, from about it."""
    apart = second[[X, Y]] - first[[X, Y]]
    way = math.hypot(*apart)
    along = apart / way
    inward = first[SIDE] * np.array([-along[1], along[0]])
    one, two = radius - first[KEPT], radius - second[KEPT]
    ahead = (one * one - two * two + way * way) / (2.0 * way)
    across = math.sqrt(max(one * one - ahead * ahead, 0.0))
    middle: Floats = first[[X, Y]] + ahead * along + across * inward
    return middle
