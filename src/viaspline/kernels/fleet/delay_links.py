"""Who opens whose bars, ready to say what a delay does.

Every bar that counts is a *link* from the bar of the other robot before which that one opens it.

Tested through ``fleet/execution/test_delay_propagation``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.packed_orders import PackedOrders
from viaspline.kernels.jit import inlined, inner, kernel


class PackedLinks(NamedTuple):
    """The links of a fleet: of which bars the opening hangs on a robot, crossing by crossing.

    Attributes:
        first: Of the crossings that a robot passes first, in the order in which it comes to where
            it begins to open them, (n + 1,).
        since: The first and the last bar of that robot before which it opens the other's; one less
            than its first bar: it does so before all of them, (k, 2).
        reach: The farthest of these last bars of its crossings up to this one, (k,).
        other: Who passes the crossing second, (k,).
        heeded: From when on that robot would have set out to pass its own bars it delays the other
            one [s], (k,).
        latest: The most by which the other one would have set out later than it [s], (k,).
        bar_first: Of the bars of each crossing, (k + 1,).
        bar: That it opens, in order along the other's path, (b,).
        by: The bar of that robot before which it does so, as in ``since``, (b,).
        later: How much later than it the other one would have set out to pass the bar then [s],
            (b,).
        usual: When the other one would have set out to pass it when it does [s], (b,).
        rank: Of a bar, in an order in which they can be passed, (bars,).
        robot: Whose a bar is, (bars,).
        shift: When that robot would have set out to pass it when it does, without waits [s],
            (bars,).
        last: Likewise to arrive when it does, (n,).
        begin: When each robot sets out [s], (n,).
    """

    first: Ints
    since: Ints
    reach: Ints
    other: Ints
    heeded: Floats
    latest: Floats
    bar_first: Ints
    bar: Ints
    by: Ints
    later: Floats
    usual: Floats
    rank: Ints
    robot: Ints
    shift: Floats
    last: Floats
    begin: Floats


@inlined
def _bar_near(place: Floats, begin: int, end: int, bar: int, passed: float) -> int:
    """The first bar of a robot that isn't before a place, sought from one nearby on."""
    while bar < end and place[bar] < passed:
        bar += 1
    while bar > begin and place[bar - 1] >= passed:
        bar -= 1
    return bar


@inlined
def _first_bar(place: Floats, begin: int, end: int, passed: float) -> int:
    """The first bar of a robot that isn't before a place."""
    while begin < end:
        middle = (begin + end) // 2
        if place[middle] < passed:
            begin = middle + 1
        else:
            end = middle
    return begin


@inner
def _bars_before(orders: PackedOrders) -> Ints:
    """The bar before which the other robot opens each bar, or one less than its first, (bars,)."""
    since = np.empty(orders.place.size, np.int64)
    bars = np.full((orders.robots.shape[0], 2), -1)  # of the bar before of the crossing and side
    for robot in range(orders.length.size):
        for b in range(orders.first[robot], orders.first[robot + 1]):
            c, other = orders.crossing[b], orders.other[b]
            side = 0 if orders.robots[c, 0] == robot else 1
            passed = min(orders.passed[b], orders.length[other])
            low, high = orders.first[other], orders.first[other + 1]
            if bars[c, side] < 0:
                bars[c, side] = _first_bar(orders.place, low, high, passed)
            else:
                bars[c, side] = _bar_near(orders.place, low, high, bars[c, side], passed)
            since[b] = bars[c, side] - 1
    return since


@inner
def _all_shifts(
    orders: PackedOrders, leaders: Ints, sequence: Ints, since: Ints, begin: Floats
) -> tuple[Floats, Floats]:
    """When robots would have set out to pass each bar when they do, and to arrive when they do.

    Args:
        orders: PackedOrders.
        leaders: Who passes each crossing first, (c,).
        sequence: Bars in an order in which they can be passed, (m,).
        since: As of ``_bars_before``.
        begin: When each robot sets out [s], (n,).

    Returns:
        For each bar [s], (bars,), and for each robot [s], (n,).
    """
    shift, last = np.full(orders.place.size, np.inf), begin.copy()
    robot_of = np.empty(orders.place.size, np.int32)
    for robot in range(begin.size):
        for b in range(orders.first[robot], orders.first[robot + 1]):
            robot_of[b] = robot
    for b in sequence:
        robot, other = robot_of[b], orders.other[b]
        if leaders[orders.crossing[b]] == other:
            before = since[b]
            earlier = begin[other] if before < orders.first[other] else shift[before]
            last[robot] = max(last[robot], earlier + orders.other_comes[b] - orders.comes[b])
        shift[b] = last[robot]
    return shift, last


@inner
def _slots(leaders: Ints, begins: Ints, most: int, robots: int) -> tuple[Ints, Ints]:
    """Number crossings by who passes them first, and by where that one begins to open them.

    Args:
        leaders: Who passes each crossing first, (c,).
        begins: By what they are sorted, less than ``most``; negative: they don't count, (c,).
        most: See there.
        robots: How many there are.

    Returns:
        The number of each, or -1, (c,), and where those of each robot begin, (n + 1,).
    """
    at, first = np.zeros(most + 1, np.int64), np.zeros(robots + 1, np.int64)
    for c in range(leaders.size):
        if begins[c] >= 0:
            at[begins[c] + 1] += 1
            first[leaders[c] + 1] += 1
    for k in range(most):
        at[k + 1] += at[k]
    for robot in range(robots):
        first[robot + 1] += first[robot]
    slot = np.full(leaders.size, np.int64(-1))
    for c in range(leaders.size):
        if begins[c] >= 0:
            slot[c] = at[begins[c]]
            at[begins[c]] += 1
    return slot, first


@kernel
def packed_links(orders: PackedOrders, leaders: Ints, sequence: Ints, begin: Floats) -> PackedLinks:
    """The links of a fleet whose robots set out at some times.

    Args:
        orders: PackedOrders.
        leaders: Who passes each crossing first, (c,).
        sequence: All bars in an order in which they can be passed, (bars,).
        begin: When each robot sets out [s], (n,).
    """
    since_of = _bars_before(orders)
    shift, last = _all_shifts(orders, leaders, sequence, since_of, begin)
    bars, robots = orders.place.size, orders.length.size
    rank, robot_of = np.empty(bars, np.int64), np.empty(bars, np.int64)
    for k in range(sequence.size):
        rank[sequence[k]] = k
    counts = np.zeros(leaders.size, np.int64)
    begins = np.full(leaders.size, np.int64(-1))  # where the leader begins to open a crossing
    for robot in range(robots):
        for b in range(orders.first[robot], orders.first[robot + 1]):
            c = orders.crossing[b]
            robot_of[b] = robot
            if leaders[c] == orders.other[b]:
                if counts[c] == 0:
                    begins[c] = since_of[b] + 1 + leaders[c]  # by robots, and by their bars
                counts[c] += 1
    slot, first = _slots(leaders, begins, bars + robots + 1, robots)
    size = first[robots]
    bar_first = np.zeros(size + 1, np.int64)
    for c in range(leaders.size):
        if slot[c] >= 0:
            bar_first[slot[c] + 1] = counts[c]
    for k in range(size):
        bar_first[k + 1] += bar_first[k]
    bar, by = np.empty(bar_first[size], np.int64), np.empty(bar_first[size], np.int64)
    later, usual = np.empty(bar.size), np.empty(bar.size)
    at = bar_first[:-1].copy()
    links = PackedLinks(
        first, np.empty((size, 2), np.int64), np.empty(size, np.int64), np.empty(size, np.int64),
        np.full(size, np.inf), np.full(size, -np.inf), bar_first, bar, by, later, usual,
        rank, robot_of, shift, last, begin.copy(),
    )  # fmt: skip
    for b in range(bars):
        c = orders.crossing[b]
        if leaders[c] != orders.other[b]:
            continue
        k, since = slot[c], since_of[b]
        i = at[k]
        at[k] += 1
        if i == bar_first[k]:
            links.since[k, 0] = since
        links.since[k, 1] = since
        bar[i], by[i], usual[i] = b, since, shift[b]
        later[i] = orders.other_comes[b] - orders.comes[b]
        links.other[k] = robot_of[b]
        links.heeded[k] = min(links.heeded[k], usual[i] - later[i])
        links.latest[k] = max(links.latest[k], later[i])
    for robot in range(robots):
        for k in range(first[robot], first[robot + 1]):
            links.reach[k] = links.since[k, 1]
            if k > first[robot]:
                links.reach[k] = max(links.reach[k], links.reach[k - 1])
    return links
