"""What one delay does to the robots of a fleet: only what comes after it is touched.

Links of one crossing are looked at together, and not at all where the one robot doesn't come so
late that the other one has to heed it. Delays are taken up in an order in which the bars can be
passed, and handed on crossing by crossing when the late robot comes there: so each is known for
good by then, but where a robot gets later yet within a crossing.

Tested through ``fleet/execution/test_delay_propagation``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.delay_links import PackedLinks
from viaspline.kernels.fleet.packed_orders import PackedOrders
from viaspline.kernels.growable import new_floats, sized_floats
from viaspline.kernels.heap import Heap, pop, push
from viaspline.kernels.jit import inner, kernel

SAME_S = 1e-9
"""Times that differ by less are one."""


class _Late(NamedTuple):
    """What is late so far.

    Attributes:
        rows: Bars that are opened later: when their robots would have set out to pass them [s], and
            which they are. And robots that come to crossings that they open: which crossing, and
            -1 less the robot, (room, 2).
        heap: Of the rows, by the ranks of the bars.
        used: How many rows there are, (1,).
        now: When each robot would have set out to pass its next bar, as far as it was told [s];
            minus infinity: it wasn't, (n,).
        low: From which bar on each of these passes its bars when it did before, (n,).
        coming: The crossing to which it comes next, as far as that has to be looked at; -1: none,
            (n,).
    """

    rows: Floats
    heap: Heap
    used: Ints
    now: Floats
    low: Ints
    coming: Ints


@inner
def _noted(late: _Late, rank: float, value: float, which: float) -> _Late:
    """With one row more."""
    room, count = late.rows.shape[0], late.used[0]
    if count == room:
        heap = Heap(np.empty(2 * room), np.empty(2 * room, np.int64), late.heap.size)
        for k in range(heap.size[0]):
            heap.keys[k], heap.items[k] = late.heap.keys[k], late.heap.items[k]
        rows = sized_floats(late.rows, count, 2 * room)
        late = _Late(rows, heap, late.used, late.now, late.low, late.coming)
    late.rows[count, 0], late.rows[count, 1] = value, which
    push(late.heap, rank, count)
    late.used[0] += 1
    return late


@inner
def _open_later(links: PackedLinks, robot: int, crossing: int, since: int, late: _Late) -> _Late:
    """Tell who waits for a robot at a crossing that it passes its bars later, from one of them on.

    Args:
        links: PackedLinks.
        robot: That is later.
        crossing: Which of those that it passes first.
        since: The first bar that it passes later.
        late: What is late so far.
    """
    value, most = late.now[robot], late.now[links.other[crossing]]
    if links.heeded[crossing] >= value or value + links.latest[crossing] <= most:
        return late  # of it, its bars from here on know already
    for i in range(links.bar_first[crossing], links.bar_first[crossing + 1]):
        then = value + links.later[i]
        is_later = then > max(most, links.usual[i]) + SAME_S
        if is_later and since <= links.by[i] < late.low[robot]:
            most = then
            late = _noted(late, float(links.rank[links.bar[i]]), then, float(links.bar[i]))
    return late


@inner
def _come_next(
    orders: PackedOrders, links: PackedLinks, robot: int, crossing: int, late: _Late
) -> _Late:
    """Note when a late robot comes to the next crossing, from one on, that it opens too late."""
    late.coming[robot] = -1
    for k in range(crossing, links.first[robot + 1]):
        since = links.since[k, 0]
        if since >= late.low[robot]:
            break
        if links.heeded[k] < late.now[robot]:
            rank = links.rank[since] + 0.5 if since >= orders.first[robot] else -0.5
            late.coming[robot] = k
            return _noted(late, rank, float(k), float(-1 - robot))
    return late


@inner
def _get_later(
    orders: PackedOrders, links: PackedLinks, robot: int, since: int, value: float, late: _Late
) -> _Late:
    """Note that a robot passes its bars later, from one of them on.

    Args:
        orders: PackedOrders.
        links: PackedLinks.
        robot: Which.
        since: The first bar that it passes later; one less than its first: all.
        value: When it would have set out to do so [s].
        late: What is late so far.
    """
    late.now[robot] = value
    low, high = max(since, orders.first[robot]), orders.first[robot + 1]
    while low < high:
        middle = (low + high) // 2
        if links.shift[middle] < value:
            low = middle + 1
        else:
            high = middle
    late.low[robot] = low
    begin, next_one = links.first[robot], links.first[robot + 1]
    ahead = begin
    while ahead < next_one:
        middle = (ahead + next_one) // 2
        if links.since[middle, 0] < since:
            ahead = middle + 1
        else:
            next_one = middle
    k = ahead - 1
    while k >= begin and links.reach[k] >= since:  # in which it is
        if links.since[k, 1] >= since:
            late = _open_later(links, robot, k, since, late)
        k -= 1
    return _come_next(orders, links, robot, ahead, late)


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
    room, count = 256, orders.length.size
    told = _Late(
        new_floats(room, 2),
        Heap(np.empty(room), np.empty(room, np.int64), np.zeros(1, np.int64)),
        np.zeros(1, np.int64),
        np.full(count, -np.inf),
        np.zeros(count, np.int64),
        np.full(count, np.int64(-1)),
    )
    touched, met = np.empty(count, np.int64), 1
    touched[0] = robot
    value = links.begin[robot] + late
    told = _get_later(orders, links, robot, orders.first[robot] - 1, value, told)
    while told.heap.size[0] > 0:
        item = pop(told.heap)
        then, which = told.rows[item, 0], int(told.rows[item, 1])
        if which < 0:
            one, k = -1 - which, int(then)
            if told.coming[one] == k:
                told = _open_later(links, one, k, links.since[k, 0], told)
                told = _come_next(orders, links, one, k + 1, told)
            continue
        one = links.robot[which]
        if then <= told.now[one] + SAME_S:
            continue
        if told.now[one] == -np.inf:
            touched[met] = one
            met += 1
        told = _get_later(orders, links, one, which, then, told)
    lates = np.empty(met)
    for i in range(met):
        lates[i] = max(told.now[touched[i]] - links.last[touched[i]], 0.0)
    return touched[:met].copy(), lates
