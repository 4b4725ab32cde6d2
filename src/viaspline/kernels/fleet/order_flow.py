"""Do the orders of a fleet ever come to an end, and when does each robot come where?

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
        All bars from the heads on in an order in which they can be passed, (m,); and for each robot
        the bar at which it is stuck, or -1, (n,).
    """
    count = orders.length.size
    come = progress.copy()
    stuck = head.copy()
    sequence = np.empty(orders.place.size, np.int64)
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
            other = orders.other[b]
            if leaders[orders.crossing[b]] == other and come[other] < orders.passed[b]:
                behind[robot], waiter[other] = waiter[other], robot
                break
            sequence[done] = b
            done += 1
            b += 1
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
    return sequence[:done], stuck


@kernel
def expected_shifts(
    orders: PackedOrders, leaders: Ints, sequence: Ints, head: Ints, begin: Floats
) -> tuple[Floats, Floats]:
    """How much later than without waits robots pass their bars, by what is known now.

    Inertia is left out: this is a lower bound for robots that drive as fast as they may.

    Args:
        orders: PackedOrders.
        leaders: Who passes each crossing first, (c,).
        sequence: Bars in an order in which they can be passed, (m,).
        head: Bars before this one have been passed, (n,).
        begin: When each robot would have set out to be where it is now without waits [s], (n,).

    Returns:
        When each robot would have set out to pass a bar when it does, without waits [s], (bars,);
        infinite where that isn't known; and likewise to arrive when it does, (n,).
    """
    shift = np.full(orders.place.size, np.inf)
    last = begin.copy()
    robot_of = np.empty(orders.place.size, np.int32)
    for robot in range(head.size):
        robot_of[orders.first[robot] : orders.first[robot + 1]] = robot
    for b in sequence:
        robot, other = robot_of[b], orders.other[b]
        if b < head[robot]:
            continue
        if leaders[orders.crossing[b]] == other:
            since = orders.since[b]
            earlier = begin[other] if since < head[other] else shift[since]
            last[robot] = max(last[robot], earlier + orders.other_comes[b] - orders.comes[b])
        shift[b] = last[robot]
    return shift, last
