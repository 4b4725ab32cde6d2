"""Do the orders of a fleet ever come to an end, and in which order can its bars be passed?

Robots are moved from bar to bar, as far as those before them let them. Bars only ever open, so all
ways of doing so end alike: if every robot arrives, then it does so whatever the delays, for the
graph of who waits for whose coming where has no cycle. If some are stuck, there is one among them.

Tested through ``fleet/execution/test_fleet_orders``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.packed_orders import PackedOrders
from viaspline.kernels.jit import kernel


@kernel
def order_flow(
    orders: PackedOrders, leaders: Ints, progress: Floats, head: Ints, fixed: Flags
) -> tuple[Ints, Ints]:
    """Drive robots from bar to bar to their ends, without any times.

    Args:
        orders: PackedOrders.
        leaders: Who passes each crossing first, (c,).
        progress: How far each robot has come [m], (n,).
        head: The first bar of each robot that may not be open, (n,).
        fixed: Whether a robot never gets on any more, (n,).

    Returns:
        Rows of bars in an order in which they can be passed, all of them from the heads on if none
        is stuck: the first of each row, and the one behind its last, (k, 2); and for each robot the
        bar at which it is stuck, or -1, (n,).
    """
    count = orders.length.size
    come = progress.copy()
    stuck = head.copy()
    heeds = np.full(leaders.size, np.int32(-1))  # who has to look at a crossing yet
    final = np.empty(leaders.size)  # and how far the other has to come until all of it is open
    for c in range(leaders.size):
        if leaders[c] >= 0:
            side = 1 if leaders[c] == orders.robots[c, 0] else 0
            heeds[c], final[c] = orders.robots[c, side], orders.final[c, side]
    rows = np.empty((orders.place.size + count, 2), np.int64)
    done = 0
    waiter = np.full(count, -1)  # the first of those who wait for a robot
    behind = np.full(count, -1)  # who waits for the same robot
    ready = np.empty(count, np.int64)  # a stack
    is_ready = ~fixed
    top = 0
    for robot in range(count - 1, -1, -1):
        if is_ready[robot]:
            ready[top] = robot
            top += 1
    while top > 0:
        top -= 1
        robot = ready[top]
        is_ready[robot] = False
        b, end = stuck[robot], orders.first[robot + 1]
        while b < end:
            c = orders.crossing[b]
            if heeds[c] == robot:
                other = leaders[c]
                if come[other] >= final[c]:
                    heeds[c] = -1
                elif come[other] < orders.passed[b]:
                    behind[robot], waiter[other] = waiter[other], robot
                    break
            b += 1
        if b > stuck[robot]:
            rows[done, 0], rows[done, 1] = stuck[robot], b
            done += 1
        stuck[robot] = b
        if b == end:
            come[robot] = np.inf if orders.vanishes[robot] else orders.length[robot]
        else:
            come[robot] = max(come[robot], orders.place[b] - orders.short[robot])
        one = waiter[robot]
        waiter[robot] = -1
        while one >= 0:
            following = behind[one]
            if come[robot] < orders.passed[stuck[one]]:
                behind[one], waiter[robot] = waiter[robot], one
            elif not is_ready[one]:
                is_ready[one] = True
                ready[top] = one
                top += 1
            one = following
    for robot in range(count):
        if stuck[robot] == orders.first[robot + 1] or fixed[robot]:
            stuck[robot] = -1
    return rows[:done].copy(), stuck
