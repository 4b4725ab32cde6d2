"""Turns close behind each other that are gentler as one.

Two are joined at a time, those first by which the whole row bends less.

Tested through ``planning/turning/test_joined_bends``.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.turning.gentle_lengths import gentle_lengths
from viaspline.kernels.turning.turn_runs import NO_JOIN, TurnRuns, all_apart, merge, take

LEAST_GENTLER = 0.1  # of the bending of two turns, that one in their place saves at least
LEAST_LONGER = 1.2  # length of one turn, over the way from its first bend to its last
LEAST_WIDER = 1.01  # its radius over what is kept from any of them
MAX_TURN_RAD = 2.5  # of one turn
LEAST_PART = 0.2  # of what the circle turns by on half of the way, that either turns by alone
LEAST_TURN_RAD = 1e-6  # of each that is joined
LEAST_LENGTH_M = 1e-9
CROWDED = 0.4  # of a line, that two turns take which may be one
REACH = 12  # turns before a join and after it, with which it is weighed at first
FIRST, LAST, INNER = range(3)  # of a join's bends, and the join that it has in itself


class RowWishes(NamedTuple):
    """A row of bends, and what the turns at them are to be like.

    Attributes:
        kept: What is kept from each [m], (n,).
        sides: To which it turns; 0 where a turn may not go round it and others, (n,).
        fast: The radius with which each is passed soonest [m], (n,).
        room_share: Of the way between two turns, that they may take.
        closed: Whether the last is followed by the first.
    """

    kept: Floats
    sides: Floats
    fast: Floats
    room_share: float
    closed: bool


class Joined(NamedTuple):
    """Two turns of a row as one.

    Attributes:
        saved: By how much the row bends less [1/m]; minus infinity where it isn't worth it.
        radius: Of the circle that is kept from all of its bends [m].
        least: What the radius has to be, so that it is worth it [m].
        spent: By how much the row may be longer than its corners then [m].
    """

    saved: float
    radius: float
    least: float
    spent: float


@inner
def _bending(turn: float, length: float) -> float:
    """The squared curvature along a turn, ramps alone [1/m]."""
    return 4.0 / 3.0 * turn * turn / max(length, LEAST_LENGTH_M)


@inner
def _is_crowded(runs: TurnRuns, wishes: RowWishes, k: int) -> bool:
    """Whether a turn can be one with the next: to one side, free, with hardly a line between."""
    before, after = wishes.sides[runs.ends[k, 1]], wishes.sides[runs.ends[k + 1, 0]]
    turn, other = runs.turns[k], runs.turns[k + 1]
    if before == 0.0 or before != after or min(turn, other) <= LEAST_TURN_RAD:
        return False
    both = runs.lengths[k] + runs.lengths[k + 1]
    return turn + other <= MAX_TURN_RAD and both >= CROWDED * 2.0 * runs.gaps[k]


@inner
def _rooms(merged: TurnRuns, count: int, lines: int, room_share: float) -> Floats:
    """What the turns before and after each line may be long together [m], (lines,)."""
    rooms = np.empty(lines)
    for i in range(lines):
        ways = merged.ways[i] + merged.ways[(i + 1) % count]
        rooms[i] = 2.0 * room_share * (merged.gaps[i] + 0.5 * ways)
    return rooms


@inner
def _no_shorter(lengths: Floats, rooms: Floats, k: int, wanted: float) -> float:
    """The length of turn k, at least what is wanted if the turns before and after it let it [m]."""
    count, beside = lengths.size, wanted
    for line in (k - 1, k):
        if rooms.size == count or 0 <= line < rooms.size:
            left = rooms[line] - lengths[line] - lengths[(line + 1) % count]
            beside = min(beside, left)
    return max(lengths[k], min(wanted, lengths[k] + beside))


@inner
def _part_spent(runs: TurnRuns, low: int, high: int, count: int, spent: float) -> float:
    """What a part of a row may be longer of what all of it may [m]."""
    part, whole = 0.0, 0.0
    for i in range(count):
        longer = runs.turns[i] ** 2 * runs.lengths[i]
        whole += longer
        if low <= i < high:
            part += longer
    return part / whole * spent


@inner
def _joined(
    runs: TurnRuns, low: int, high: int, k: int, closed: bool, spent: float, wishes: RowWishes,
    merged: TurnRuns,
) -> Joined:  # fmt: skip
    """Turns k and k + 1 as one, weighed with those from ``low`` to before ``high``.

    The one turn, of length l, has its arc between its bends, a way d long, and ramps before and
    after it: its radius is (l + d) / 2 t. It is nearly as gentle as one of ramps alone, as long,
    in the middle of that way.

    Args:
        runs: The row.
        low: The first turn of the part that it is weighed with.
        high: The turn after the last.
        k: The first of the two.
        closed: Whether the last of the part is followed by its first.
        spent: By how much the part may be longer than its corners [m].
        wishes: Of the row.
        merged: Filled with the part that has one turn in their place.
    """
    count, at = high - low - 1, k - low
    merge(runs, low, high, k, merged)
    before, after = 0.0, 0.0
    for i in range(low, high):
        before += runs.turns[i] ** 2
    for i in range(count):
        after += merged.turns[i] ** 2
    spent *= after / before  # as much for each turn
    rooms = _rooms(merged, count, count if closed else count - 1, wishes.room_share)
    lengths = gentle_lengths(merged.turns[:count], rooms, closed, spent)
    fast, kept = 0.0, 0.0
    for i in range(runs.ends[k, 0], runs.ends[k + 1, 1] + 1):
        fast, kept = max(fast, wishes.fast[i]), max(kept, wishes.kept[i])
    turn, way = merged.turns[at], merged.ways[at]
    lengths[at] = _no_shorter(lengths, rooms, at, turn * fast)
    merged.lengths[:count] = lengths
    radius = 0.5 * (lengths[at] + way) / turn
    part = 0.5 * way / min(runs.turns[k], runs.turns[k + 1])
    least = max(way / turn, LEAST_WIDER * kept, LEAST_PART * part)
    saved = 0.0
    for i in range(low, high):
        saved += _bending(runs.turns[i], runs.lengths[i])
    for i in range(count):
        saved -= _bending(merged.turns[i], lengths[i])
    two = _bending(runs.turns[k], runs.lengths[k]) + _bending(
        runs.turns[k + 1], runs.lengths[k + 1]
    )
    if lengths[at] < LEAST_LONGER * way or radius < least or not saved > LEAST_GENTLER * two:
        saved = -math.inf
    return Joined(saved, radius, least, spent)


@inner
def _near(
    runs: TurnRuns, count: int, k: int, spent: float, wishes: RowWishes, merged: TurnRuns
) -> Joined:  # fmt: skip
    """Turns k and k + 1 as one, weighed with the turns about them: all where they are hardly more.

    They may lengthen the path by their part.
    """
    low, high = max(k - REACH, 0), min(k + 2 + REACH, count)
    if high - low == count:
        return _joined(runs, 0, count, k, wishes.closed, spent, wishes, merged)
    part = _part_spent(runs, low, high, count, spent)
    return _joined(runs, low, high, k, False, part, wishes, merged)


@inner
def _most_crowded(
    runs: TurnRuns, count: int, spent: float, weighed: Floats, wishes: RowWishes, merged: TurnRuns
) -> int:  # fmt: skip
    """The turn that is best one with the next, -1 where none is worth it.

    Args:
        runs: The row.
        count: Of its turns.
        spent: By how much it may be longer than its corners [m].
        weighed: What each saves if it is one with the next, by its first bend; NaN where that
            isn't known, and filled then, (n,).
        wishes: Of the row.
        merged: To work in.
    """
    best, most = -1, -math.inf
    for k in range(count - 1):
        if not _is_crowded(runs, wishes, k):
            continue
        first = runs.ends[k, 0]
        if math.isnan(weighed[first]):
            weighed[first] = _near(runs, count, k, spent, wishes, merged).saved
        if weighed[first] > most:
            best, most = k, weighed[first]
    return best


@kernel
def joined_turns(
    turns: Floats, gaps: Floats, lengths: Floats, spent: float, wishes: RowWishes
) -> tuple[Ints, Floats, Ints]:
    """Turns of a row that are gentler as one.

    Args:
        turns: By how much it turns at each bend, none negative [rad], (n,).
        gaps: The way from each to the next [m], (n - 1,), or (n,) when closed.
        lengths: Of the turns [m], (n,).
        spent: By how much the path may be longer than its corners [m].
        wishes: What else is asked of them.

    Returns:
        Every join that was made, those that others have in themselves among them: the columns
        ``FIRST``, ``LAST`` and ``INNER``, (j, 3), its radius and the least one that is worth it
        [m], (j, 2); which of them are left, in their order, (k,).
    """
    runs, merged = all_apart(turns, gaps, lengths), all_apart(turns, gaps, lengths)
    count, made = turns.size, 0
    joins, radii = np.empty((count, 3), np.int64), np.empty((count, 2))
    weighed = np.full(count, np.nan)
    while True:
        k = _most_crowded(runs, count, spent, weighed, wishes, merged)
        if k < 0:
            break
        joined = _joined(runs, 0, count, k, wishes.closed, spent, wishes, merged)
        if joined.saved == -math.inf:
            weighed[runs.ends[k, 0]] = -math.inf
            continue
        joins[made, FIRST], joins[made, LAST] = runs.ends[k, 0], runs.ends[k + 1, 1]
        joins[made, INNER] = runs.joins[k] if runs.joins[k] != NO_JOIN else runs.joins[k + 1]
        radii[made, 0], radii[made, 1] = joined.radius, joined.least
        take(runs, count, k, made, merged)
        spent, count, made = joined.spent, count - 1, made + 1
        for i in range(max(k - REACH - 1, 0), min(k + REACH + 2, count)):
            weighed[runs.ends[i, 0]] = np.nan
    left = runs.joins[:count]
    return joins[:made].copy(), radii[:made].copy(), left[left != NO_JOIN]
