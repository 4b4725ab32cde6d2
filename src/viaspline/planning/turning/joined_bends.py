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

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.turning.joined_turns import RowWishes, joined_turns
from viaspline.planning.turning.bend_row import DETOUR, KEPT, SIDE, Bends, X, Y

SMALLER = 0.7  # a radius without room, over the next one


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
        widest: Than which radius none is faster at each [m], (n,).
    """

    turns: Floats
    gaps: Floats
    lengths: Floats
    fast: Floats
    spent: float
    widest: Floats


def joins_worth_it(bends: Bends, wishes: TurnWishes, room_share: float) -> tuple[Join, ...]:
    """Bends of a row that one turn goes round more gently, each in one join at most.

    Args:
        bends: The row, without needless ones.
        wishes: Of their turns.
        room_share: Of the way between two turns, that they may take.
    """
    free = (bends.vias == DETOUR) & np.isinf(bends.swings)
    sides = np.where(free, bends.rows[:, SIDE], 0.0)
    asked = RowWishes(bends.rows[:, KEPT].copy(), sides, wishes.fast, room_share, bends.closed)
    table, radii, left = joined_turns(
        wishes.turns, wishes.gaps, wishes.lengths, wishes.spent, asked
    )
    joins: list[Join] = []  # one may have one of those before it in itself
    for (first, last, inner), (radius, least) in zip(table.tolist(), radii.tolist(), strict=True):
        joins.append(Join(first, last, radius, least, None if inner < 0 else joins[inner]))
    return tuple(joins[k] for k in left.tolist())


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
