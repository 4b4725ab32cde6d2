"""What one delay does to the robots of a fleet: only what comes after it is touched.

Every bar that counts is a *link* from the bar of the other robot before which that one opens it.
Links of one crossing are looked at together, and not at all where the one robot doesn't come so
late that the other one has to heed it. Delays are taken up in an order in which the bars can be
passed, so each is known for good when it is handed on.

Tested through ``fleet/execution/test_delay_propagation``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.order_flow import expected_shifts
from viaspline.kernels.fleet.packed_orders import PackedOrders
from viaspline.kernels.growable import new_floats, sized_floats
from viaspline.kernels.heap import Heap, pop, push
from viaspline.kernels.jit import inlined, inner, kernel

SAME_S = 1e-9
"""Times that differ by less are one."""


class PackedLinks(NamedTuple):
    """The links of a fleet: of which bars the opening hangs on a robot, crossing by crossing.

    Attributes:
        first: Of the crossings that a robot passes first, (n + 1,).
        since: The first and the last bar of that robot before which it opens the other's; one less
            than its first bar: it does so before all of them, (k, 2).
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
def _since(orders: PackedOrders, bar: int) -> int:
    """The bar before which the other robot opens a bar, or one less than its first."""
    since = orders.since[bar]
    return since if since >= 0 else orders.first[orders.other[bar]] - 1


@kernel
def packed_links(orders: PackedOrders, leaders: Ints, sequence: Ints, begin: Floats) -> PackedLinks:
    """The links of a fleet whose robots set out at some times.

    Args:
        orders: PackedOrders.
        leaders: Who passes each crossing first, (c,).
        sequence: All bars in an order in which they can be passed, (bars,).
        begin: When each robot sets out [s], (n,).
    """
    shift, last = expected_shifts(orders, leaders, sequence, orders.first[:-1], begin)
    bars, robots = orders.place.size, orders.length.size
    rank, robot_of = np.empty(bars, np.int64), np.empty(bars, np.int64)
    for k in range(sequence.size):
        rank[sequence[k]] = k
    counts = np.zeros(leaders.size + 1, np.int64)
    for robot in range(robots):
        for b in range(orders.first[robot], orders.first[robot + 1]):
            robot_of[b] = robot
            if leaders[orders.crossing[b]] == orders.other[b]:
                counts[orders.crossing[b] + 1] += 1
    slot = np.full(leaders.size, -1)
    first = np.zeros(robots + 1, np.int64)
    for c in range(leaders.size):
        if counts[c + 1] > 0:
            first[leaders[c] + 1] += 1
    for robot in range(robots):
        first[robot + 1] += first[robot]
    fill = first[:-1].copy()
    for c in range(leaders.size):
        if counts[c + 1] > 0:
            slot[c] = fill[leaders[c]]
            fill[leaders[c]] += 1
    size = first[robots]
    bar_first = np.zeros(size + 1, np.int64)
    for c in range(leaders.size):
        if slot[c] >= 0:
            bar_first[slot[c] + 1] = counts[c + 1]
    for k in range(size):
        bar_first[k + 1] += bar_first[k]
    bar, by = np.empty(bar_first[size], np.int64), np.empty(bar_first[size], np.int64)
    later, usual = np.empty(bar.size), np.empty(bar.size)
    at = bar_first[:-1].copy()
    links = PackedLinks(
        first, np.empty((size, 2), np.int64), np.empty(size, np.int64), np.full(size, np.inf),
        np.full(size, -np.inf), bar_first, bar, by, later, usual, rank, robot_of, shift, last,
        begin.copy(),
    )  # fmt: skip
    for b in range(bars):
        c = orders.crossing[b]
        if leaders[c] != orders.other[b]:
            continue
        k, since = slot[c], _since(orders, b)
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
    return links


class _LateBars(NamedTuple):
    """Bars that are opened later than they were.

    Attributes:
        rows: When their robots would have set out to pass them [s], and which they are, (room, 2).
        heap: Of the rows, by the ranks of the bars.
        used: How many rows there are, (1,).
        now: When each robot would have set out to pass its next bar, as far as it was told [s];
            minus infinity: it wasn't, (n,).
    """

    rows: Floats
    heap: Heap
    used: Ints
    now: Floats


@inner
def _roomy(told: _LateBars) -> _LateBars:
    """With room for one more."""
    room, count = told.rows.shape[0], told.used[0]
    if count < room:
        return told
    heap = Heap(np.empty(2 * room), np.empty(2 * room, np.int64), told.heap.size)
    for k in range(heap.size[0]):
        heap.keys[k], heap.items[k] = told.heap.keys[k], told.heap.items[k]
    return _LateBars(sized_floats(told.rows, count, 2 * room), heap, told.used, told.now)


@inner
def _hand_on(
    orders: PackedOrders, links: PackedLinks, robot: int, since: int, value: float, told: _LateBars
) -> _LateBars:
    """Tell those who wait for a robot that it passes its bars later, from one of them on.

    Args:
        orders: PackedOrders.
        links: PackedLinks.
        robot: That is later.
        since: The first bar that it passes later.
        value: When it would have set out to do so [s].
        told: What was told so far.
    """
    low, high = max(since, orders.first[robot]), orders.first[robot + 1]
    while low < high:  # from where on it passes its bars when it did before
        middle = (low + high) // 2
        if links.shift[middle] < value:
            low = middle + 1
        else:
            high = middle
    for k in range(links.first[robot], links.first[robot + 1]):
        is_apart = links.since[k, 1] < since or links.since[k, 0] >= low
        if is_apart or links.heeded[k] >= value:
            continue
        most = told.now[links.other[k]]  # of it, its bars from here on know already
        if value + links.latest[k] <= most:
            continue
        for i in range(links.bar_first[k], links.bar_first[k + 1]):
            then = value + links.later[i]
            is_later = then > max(most, links.usual[i]) + SAME_S
            if is_later and since <= links.by[i] < low:
                most, bar = then, links.bar[i]
                told = _roomy(told)
                count = told.used[0]
                told.rows[count, 0], told.rows[count, 1] = then, bar
                push(told.heap, links.rank[bar], count)
                told.used[0] += 1
    return told


@kernel
def delayed_arrivals(
    orders: PackedOrders, links: PackedLinks, robot: int, late: float
) -> tuple[Ints, Floats]:
    """Who arrives later if one robot sets out later.

    Args:
        orders: PackedOrders.
        links: PackedLinks.
        robot: That sets out later.
        late: By how much [s], more than 0.

    Returns:
        The robots, (k,), and by how much later each arrives [s], (k,).
    """
    room = 256
    told = _LateBars(
        new_floats(room, 2),
        Heap(np.empty(room), np.empty(room, np.int64), np.zeros(1, np.int64)),
        np.zeros(1, np.int64),
        np.full(orders.length.size, -np.inf),
    )
    now = told.now
    touched, met = np.empty(orders.length.size, np.int64), 1
    touched[0] = robot
    now[robot] = links.begin[robot] + late
    told = _hand_on(orders, links, robot, orders.first[robot] - 1, now[robot], told)
    while told.heap.size[0] > 0:
        item = pop(told.heap)
        then, bar = told.rows[item, 0], int(told.rows[item, 1])
        one = links.robot[bar]
        if then <= now[one] + SAME_S:
            continue
        if now[one] == -np.inf:
            touched[met] = one
            met += 1
        now[one] = then
        told = _hand_on(orders, links, one, bar, then, told)
    lates = np.empty(met)
    for i in range(met):
        lates[i] = max(now[touched[i]] - links.last[touched[i]], 0.0)
    return touched[:met].copy(), lates
