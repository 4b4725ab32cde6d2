"""Two bends close behind each other that one turn goes round.

Where two corners stand so close that a turn at each has no room to be wide, a good driver takes
them as one. The two bends become one that a circle about both is kept from: its turn touches both.

Tested through ``planning/turning/test_joined_bends``.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from dataclasses import dataclass, replace

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.turning.gentle_lengths import LONGER
from viaspline.planning.turning.bend_row import DETOUR, KEPT, SIDE, Bends, X, Y

GENTLER = 0.75  # bending of one turn, over that of the two, at most
LEAST_LONGER = 1.2  # length of one turn, over the way between the two
LEAST_WIDER = 1.01  # its radius over what is kept from either
SMALLER = 0.7  # a radius without room, over the next one
MAX_TURN_RAD = 2.5  # of one turn
LEAST_TURN_RAD = 1e-6  # of either of the two
LEAST_LENGTH_M = 1e-9


@dataclass(frozen=True)
class Join:
    """Two bends of a row that one turn goes round.

    Attributes:
        first: The first of them.
        radius: Of the circle that is kept from both [m].
        least: What the radius has to be, so that it is worth it [m].
        bending: Of the one turn, over that of the two.
    """

    first: int
    radius: float
    least: float
    bending: float


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


def joins_worth_it(bends: Bends, wishes: TurnWishes) -> tuple[Join, ...]:
    """Pairs of bends of a row that one turn goes round more gently, none of them in two pairs.

    Args:
        bends: The row, without needless ones.
        wishes: Of their turns.
    """
    tried = (_joined_at(k, bends, wishes) for k in range(len(bends.rows) - 1))
    taken: set[int] = set()
    chosen = []
    for join in sorted((join for join in tried if join), key=lambda join: join.bending):
        if not taken & {join.first, join.first + 1}:
            taken |= {join.first, join.first + 1}
            chosen.append(join)
    return tuple(sorted(chosen, key=lambda join: join.first))


def _joined_at(k: int, bends: Bends, wishes: TurnWishes) -> Join | None:
    """The join of bends k and k + 1, if it is worth it.

    The one turn, of length l, has its arc between the two, a way d long, and ramps before and
    after it: its radius is (l + d) / 2 t, and it bends by (l + 2 d) / 3 radius².
    """
    pair = slice(k, k + 2)
    rows, turns, lengths = bends.rows[pair], wishes.turns[pair], wishes.lengths[pair]
    free = (bends.vias[pair] == DETOUR).all() and np.isinf(bends.swings[pair]).all()
    if not free or rows[0, SIDE] != rows[1, SIDE] or turns.min() <= LEAST_TURN_RAD:
        return None
    turn, way = float(turns.sum()), float(wishes.gaps[k])
    length = _length_of_one(k, turn, wishes)
    if turn > MAX_TURN_RAD or length < LEAST_LONGER * way:
        return None
    radius = 0.5 * (length + way) / turn
    least = max(way / turn, LEAST_WIDER * float(rows[:, KEPT].max()))
    one = (length + 2.0 * way) / (3.0 * radius * radius)
    two = 4.0 / 3.0 * float((turns * turns / np.maximum(lengths, LEAST_LENGTH_M)).sum())
    if radius < least or one > GENTLER * two:
        return None
    return Join(k, radius, least, one / two)


def _length_of_one(k: int, turn: float, wishes: TurnWishes) -> float:
    """How long one turn at bends k and k + 1 should be, as far as its neighbours leave room [m]."""
    gaps, lengths = wishes.gaps, wishes.lengths
    after = (k + 2) % len(lengths)
    beside = min(gaps[k - 1] - 0.5 * lengths[k - 1], gaps[k + 1] - 0.5 * lengths[after])
    gentle = min(float(lengths.max()), LONGER * wishes.spent / turn**2)
    fast = turn * float(wishes.fast[k : k + 2].max())
    return float(min(max(gentle, fast), wishes.gaps[k] + 2.0 * beside))


def with_joins(bends: Bends, joins: Collection[Join]) -> Bends:
    """A row with one bend for the two of each join: the first of them is in its place.

    Args:
        bends: The row.
        joins: None of them with a bend of another.

    Example:
        >>> from viaspline.planning.turning.bend_row import bend
        >>> row = np.array([bend(-9, 0), bend(-3, 0, 1, -1), bend(3, 0, 1, -1), bend(9, 0)])
        >>> bends = Bends.free(row, np.array([0, DETOUR, DETOUR, 1]))
        >>> with_joins(bends, [Join(1, 6.0, 3.0, 0.5)]).rows[1, :4]
        array([ 0., -4.,  6., -1.])
    """
    rows = bends.rows.copy()
    for join in joins:
        first, second = bends.rows[join.first : join.first + 2]
        rows[join.first, [X, Y]] = _middle(first, second, join.radius)
        rows[join.first, KEPT] = join.radius
    return replace(bends, rows=rows).without(seconds_of(joins))


def seconds_of(joins: Collection[Join]) -> Ints:
    """The second bend of each join, which has no row of its own, (k,)."""
    return np.array([join.first + 1 for join in joins], np.int64)


def loosened(joins: Collection[Join], tight: Collection[int]) -> Iterator[Join]:
    """The joins with smaller radii where there is no room, but those that are too small then.

    Args:
        joins: Those of a row.
        tight: Bends of the row where there is no room.
    """
    for join in joins:
        smaller = join
        if join.first in tight:
            smaller = replace(join, radius=SMALLER * join.radius)
        if smaller.radius >= join.least:
            yield smaller


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
