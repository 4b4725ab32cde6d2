"""Points that an order passes backwards, moved to where they are passed forwards, at least cost.

First they, then all others, one by one: each to the place of the order where the fewest are passed
backwards then, and of such places where the round grows least, until nothing is gained by it.

Tested through ``planning/routing/test_facing_points``.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.planning.routing.facing_points import NOWHERE, FacingPoints

LEAST_GAIN = 1e-9  # less by less is not less [m or s]

Between = Callable[[Ints, Ints], Floats]
"""What the ways between points cost, elementwise; those to NOWHERE cost nothing that counts."""


def moved_forwards(stops: tuple[int, ...], between: Between, facing: FacingPoints) -> list[int]:
    """An order with as few of its points passed backwards as moves of single ones give.

    Args:
        stops: The points in their order, from the first to the last; the first stays, and so does
            the last, which may be ``NOWHERE``: then the one before it is where the round ends.
        between: What ways cost.
        facing: The directions that points face.

    >>> row = np.array([[0.0, 0], [5, 0], [8, 0], [9, 0]])
    >>> facing = FacingPoints(row, np.array([[0.0, 0], [-1, 0], [0, 0], [0, 0]]))
    >>> moved_forwards((0, 1, 2, 3), lambda a, b: abs(row[a, 0] - row[b, 0]), facing)
    [0, 2, 1, 3]
    """
    tour = list(stops)
    wrong, cost = facing.backwards(tour), math.inf
    if not wrong:
        return tour
    gains = True
    while gains:
        least = (len(wrong), cost - LEAST_GAIN)
        for point in [*wrong, *tour[1:-1]]:
            tour = _moved(tour, point, between, facing)
        wrong, cost = facing.backwards(tour), _total(tour, between)
        gains = (len(wrong), cost) < least
    return tour


def _total(tour: list[int], between: Between) -> float:
    """What an order costs."""
    at = np.array([stop for stop in tour if stop != NOWHERE], np.int64)
    return float(between(at[:-1], at[1:]).sum())


def _moved(tour: list[int], point: int, between: Between, facing: FacingPoints) -> list[int]:
    """An order with one point where that leaves the fewest backwards, at least cost."""
    at = np.array([stop for stop in tour if stop != point], np.int64)
    first, last, own = at[:-1], at[1:], np.full(len(at) - 1, point)
    wrong = facing.wrong(first, own, last).astype(np.int64)
    others = (at[:-2], at[1:-1], at[2:])
    now = facing.wrong(*others).astype(np.int64)
    wrong[1:] += facing.wrong(others[0], others[1], own[1:]) - now
    wrong[:-1] += facing.wrong(own[1:], others[1], others[2]) - now
    onward = between(own, last) - between(first, last)
    more = between(first, own) + np.where(last == NOWHERE, 0.0, onward)
    slot = int(np.lexsort((more, wrong))[0])
    return [*at[: slot + 1].tolist(), point, *at[slot + 1 :].tolist()]
