"""The order of points that costs least, by what the way from each to each other one costs.

The travelling salesman's problem: exact for few points (Held and Karp, "A Dynamic Programming
Approach to Sequencing Problems", 1962), else by exchanges until none makes the round cost less
(2-opt and Or-opt). Of points that face a direction as few as can be are passed backwards: of few
points in the best order of all, of many where moves of single ones lead.

Tested through ``planning/routing/test_visit_order`` and ``planning/routing/test_facing_points``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import combinations, product
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.planning.routing.facing_points import NOWHERE, FacingPoints
from viaspline.planning.routing.moved_forwards import LEAST_GAIN, Between, moved_forwards
from viaspline.planning.routing.round_cost import RoundLength

MAX_VIAS_ALL_ORDERS: Final = 9
"""Up to so many via points all orders are compared."""

Cost = Callable[[tuple[int, ...]], float]
"""Of a round past points in their order."""

_Begun = tuple[int, float, tuple[int, ...]]
"""How many points were passed backwards, what the way so far costs, and its via points, from 0."""


def last_stop(points: int, count: int, *, closed: bool) -> int | None:
    """The point at which a round ends, if it isn't one of its via points."""
    if closed:
        return 0
    return count + 1 if points > count + 1 else None


def round_of(order: tuple[int, ...], last: int | None) -> tuple[int, ...]:
    """The points of a round with its via points, counted from 0, in an order."""
    ends = () if last is None else (last,)
    return (0, *(k + 1 for k in order), *ends)


def round_to_end(order: tuple[int, ...], last: int | None) -> tuple[int, ...]:
    """The points of a round, ``NOWHERE`` as its last where it just ends at a via point."""
    return round_of(order, NOWHERE if last is None else last)


def shortest_order(
    lengths: Floats, count: int, last: int | None, facing: FacingPoints | None = None
) -> tuple[int, ...]:
    """The order of the via points, from 0, between the first point and the last.

    Args:
        lengths: Of the ways from each point to each other one, start and goal among them, (n, n);
            there and back may differ.
        count: How many via points there are: points 1 to ``count``.
        last: See ``last_stop``.
        facing: The directions that points face; None if none does.

    >>> shortest_order(np.abs(np.subtract.outer([0, 30, 10, 40], [0, 30, 10, 40])), 2, 3)
    (1, 0)
    """
    if count <= MAX_VIAS_ALL_ORDERS:
        return _held_karp(lengths, count, last, facing)
    rounds = RoundLength(lengths)
    order = exchanged(lambda it: rounds.of(round_of(it, last)), _nearest_first(lengths, count))
    if facing is None:
        return order
    return forwards(order, last, lambda first, then: np.asarray(lengths[first, then]), facing)


def forwards(
    order: tuple[int, ...], last: int | None, between: Between, facing: FacingPoints
) -> tuple[int, ...]:
    """An order of via points, from 0, with those moved that it passes backwards.

    Args:
        order: A short one.
        last: See ``last_stop``.
        between: What ways between points cost.
        facing: The directions that points face.
    """
    stops = moved_forwards(round_to_end(order, last), between, facing)
    return tuple(k - 1 for k in stops[1:-1])


def _held_karp(
    lengths: Floats, count: int, last: int | None, facing: FacingPoints | None
) -> tuple[int, ...]:
    """The best of all orders, built up from the best of all subsets of the via points.

    What was come to from ahead is kept apart from what wasn't: it matters as it is left.
    """
    coming, going = _against(facing, len(lengths))
    best: dict[tuple[int, int, bool], _Begun] = {
        (1 << k, k, bool(coming[0, k + 1])): (0, float(lengths[0, k + 1]), (k,))
        for k in range(count)
    }
    for size in range(2, count + 1):
        for chosen in combinations(range(count), size):
            mask = sum(1 << k for k in chosen)
            for k, j, from_ahead in product(chosen, chosen, (False, True)):
                begun = best.get((mask ^ (1 << k), j, from_ahead))
                if begun is None:
                    continue
                wrong, length, order = begun
                step = (
                    wrong + int(from_ahead and going[j + 1, k + 1]),
                    length + float(lengths[j + 1, k + 1]),
                    (*order, k),
                )
                here = (mask, k, bool(coming[j + 1, k + 1]))
                best[here] = min(best.get(here, step), step)
    full = (1 << count) - 1
    ends = [
        (
            wrong + int(from_ahead and (last is None or going[k + 1, last])),
            length + (0.0 if last is None else float(lengths[k + 1, last])),
            order,
        )
        for k, from_ahead in product(range(count), (False, True))
        if (full, k, from_ahead) in best
        for wrong, length, order in [best[full, k, from_ahead]]
    ]
    return min(ends)[2] if ends else ()


def _against(facing: FacingPoints | None, count: int) -> tuple[Flags, Flags]:
    """Whether the way between two points comes to its last from ahead, or leaves its first behind.

    Both (count, count), by first and last.
    """
    if facing is None:
        return np.zeros((count, count), np.bool_), np.zeros((count, count), np.bool_)
    ahead = facing.ahead(np.arange(count)[:, None], np.arange(count))
    return ahead.T > 0.0, ahead < 0.0


def _nearest_first(lengths: Floats, count: int) -> tuple[int, ...]:
    """Always on to the nearest that is left."""
    here, order = 0, []
    left = set(range(count))
    while left:
        here = min(left, key=lambda k: (lengths[here, k + 1], k)) + 1
        order.append(here - 1)
        left.remove(here - 1)
    return tuple(order)


def exchanged(cost: Cost, order: tuple[int, ...]) -> tuple[int, ...]:
    """Take the first exchange that makes a round cost less, until there is none.

    Args:
        cost: Of an order.
        order: To begin with.
    """
    best = cost(order)
    improved = True
    while improved:
        improved = False
        for candidate in _neighbours(order):
            its = cost(candidate)
            if its < best - LEAST_GAIN:
                order, best, improved = candidate, its, True
                break
    return order


def _neighbours(order: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
    """Orders with a part turned round (2-opt), or one of up to three points elsewhere (Or-opt)."""
    count = len(order)
    for i, j in combinations(range(count + 1), 2):
        if j - i > 1:
            yield order[:i] + order[i:j][::-1] + order[j:]
    for size in (1, 2, 3):
        for i in range(count - size + 1):
            part, rest = order[i : i + size], order[:i] + order[i + size :]
            for j in range(len(rest) + 1):
                if j != i:
                    yield rest[:j] + part + rest[j:]
                    yield rest[:j] + part[::-1] + rest[j:]
