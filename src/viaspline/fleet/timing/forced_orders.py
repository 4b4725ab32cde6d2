"""Who has to pass before whom, whatever the timing: starts and resting places in others' way.

While a robot stands at its start, nobody passes there: it leaves before they come. Once it rests at
its goal nobody passes there any more: they have passed before it comes. Where these orders don't go
round in a circle, every robot can be timed one after the other: each can wait at home until all
before it have arrived, for none of them passes there (compare Čáp, Novák, Kleiner and Selecký, IEEE
T-ASE 2015, on infrastructures in which every robot can rest).
"""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Flags, Ints
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_passages import PackedPassages


@dataclass(frozen=True, eq=False)
class TimingOrder:
    """The order in which robots are timed.

    Attributes:
        order: Robots, each after all that have to pass before it, (m,).
        circular: Those that wait for each other in a circle, or for such ones, (n - m,).
    """

    order: Ints
    circular: Ints


def forced_orders(courses: PackedCourses, passages: PackedPassages, vanishes: Flags) -> Ints:
    """Pairs of robots of which the first has to pass before the second.

    Args:
        courses: PackedCourses.
        passages: PackedPassages.
        vanishes: Which robots leave the world when they arrive, (n,).

    Returns:
        Each pair once, (m, 2). Where the one passes the home of the other, which is away meanwhile,
        each has to pass before the other: that forces no order on their timing, and is left out.
    """
    owner = np.repeat(np.arange(vanishes.size), np.diff(passages.first))
    at_start = passages.entry == courses.first[owner]
    at_goal = (passages.exit == courses.first[owner + 1] - 2) & ~vanishes[owner]
    leaves = np.column_stack([owner[at_start], passages.other[at_start]])
    arrives = np.column_stack([passages.other[at_goal], owner[at_goal]])
    pairs = np.unique(np.concatenate([leaves, arrives]), axis=0)
    there, back = pairs @ (vanishes.size, 1), pairs @ (1, vanishes.size)
    return pairs[~np.isin(there, back)]


def timing_order(pairs: Ints, ranks: Sequence[tuple[float, ...]]) -> TimingOrder:
    """Robots in the order of their ranks, but each after all that have to pass before it.

    Args:
        pairs: Who has to pass before whom, (m, 2).
        ranks: Of each robot; the least comes first.

    Example:
        >>> found = timing_order(np.array([[2, 0]]), [(0.0,), (1.0,), (2.0,)])
        >>> found.order.tolist(), found.circular.tolist()
        ([1, 2, 0], [])
    """
    count = len(ranks)
    later: list[list[int]] = [[] for _ in range(count)]
    waits = [0] * count
    for before, after in pairs.tolist():
        later[before].append(after)
        waits[after] += 1
    ready = [(*ranks[r], r) for r in range(count) if waits[r] == 0]
    heapq.heapify(ready)
    order = []
    while ready:
        robot = int(heapq.heappop(ready)[-1])
        order.append(robot)
        for other in later[robot]:
            waits[other] -= 1
            if waits[other] == 0:
                heapq.heappush(ready, (*ranks[other], other))
    circular = sorted(set(range(count)) - set(order))
    return TimingOrder(np.array(order, np.int64), np.array(circular, np.int64))
