"""When each robot comes where by the orders of a fleet, if none is delayed any more.

Robots are moved from bar to bar as in ``order_flow``, and how late they are is reckoned on the way.
Most bars make nobody later: what a robot is late by changes at a few of them, and only these are
kept. A crossing that can't make its second robot later than it is already, is passed as a whole.

Tested through ``fleet/execution/test_order_times``.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints, Steps
from viaspline.kernels.fleet.packed_orders import PackedOrders
from viaspline.kernels.jit import inlined, inner, kernel

NOBODY: Final = -1
ROUNDING_S = 1e-9
"""A crossing is passed as a whole if it makes its second robot come sooner than it does by more."""


class OrderTimes(NamedTuple):
    """When robots pass their bars, by where they get later.

    Attributes:
        reached: The first bar that each robot doesn't pass, (n,); one beyond its last: it arrives.
        stuck: The bar at which each robot is stuck for ever, or -1, (n,).
        last: When each would have set out to arrive when it does, or to be where it gets to,
            without waits [s], (n,).
        begin: When each would have set out to be where it is now [s], (n,).
        final: The last of each robot's *delays*, or -1: it gets no later than it is, (n,).
        bars: Of each delay the bar at which its robot gets later, and that robot's delay before, or
            -1, (k, 2).
        delays: The place of that bar [m], and when the robot would have set out to pass it when it
            does [s], (k, 2).
    """

    reached: Ints
    stuck: Ints
    last: Floats
    begin: Floats
    final: Ints
    bars: Ints
    delays: Floats


class _Heeded(NamedTuple):
    """Who has to look at which crossings yet: what is asked at every bar lies together.

    Attributes:
        robots: Who looks at a crossing, or nobody, and who passes it first, (c, 2).
        bounds: ``final`` and ``most`` of the former, (c, 2).
    """

    robots: Steps
    bounds: Floats


@inner
def _all_heeded(orders: PackedOrders, leaders: Ints) -> _Heeded:
    """Whoever is the second in a crossing looks at it."""
    count = leaders.size
    heeded = _Heeded(
        np.empty((count, 2), np.int32),
        np.empty((count, 2)),
    )
    for c in range(count):
        side = 1 if leaders[c] == orders.robots[c, 0] else 0
        heeded.robots[c, 0] = orders.robots[c, side] if leaders[c] >= 0 else NOBODY
        heeded.robots[c, 1] = leaders[c]
        heeded.bounds[c, 0], heeded.bounds[c, 1] = orders.final[c, side], orders.most[c, side]
    return heeded


@inlined
def _shift_before(times: OrderTimes, robot: int, place: float) -> float:
    """When a robot would have set out to pass the last bar before a place when it does [s]."""
    at = times.final[robot]
    while at >= 0 and times.delays[at, 0] >= place:
        at = times.bars[at, 1]
    return times.delays[at, 1] if at >= 0 else times.begin[robot]


@inlined
def shift_at(times: OrderTimes, robot: int, bar: int) -> float:
    """When a robot would have set out to pass a bar when it does [s]; infinite: it doesn't."""
    if bar >= times.reached[robot]:
        return np.inf
    at = times.final[robot]
    while at >= 0 and times.bars[at, 0] > bar:
        at = times.bars[at, 1]
    return times.delays[at, 1] if at >= 0 else times.begin[robot]


@inlined
def _is_idle(
    orders: PackedOrders,
    times: OrderTimes,
    heeded: _Heeded,
    come: Floats,
    robot: int,
    crossing: int,
) -> bool:
    """Whether all of a crossing is open, and nothing of it makes a robot later than it is."""
    other, final = heeded.robots[crossing, 1], heeded.bounds[crossing, 0]
    if come[other] < final:
        return False
    latest = _shift_before(times, other, min(final, orders.length[other]))
    return latest + heeded.bounds[crossing, 1] < times.last[robot] - ROUNDING_S


@inner
def new_order_times(
    orders: PackedOrders, leaders: Ints, progress: Floats, head: Ints, fixed: Flags, begin: Floats
) -> OrderTimes:
    """As ``order_times``."""
    count, bars = orders.length.size, orders.place.size
    times = OrderTimes(
        head.copy(), np.full(count, -1), begin.copy(), begin.copy(), np.full(count, -1),
        np.empty((bars, 2), np.int64), np.empty((bars, 2)),
    )  # fmt: skip
    delays = 0
    heeded = _all_heeded(orders, leaders)
    come = progress.copy()
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
        b, end = times.reached[robot], orders.first[robot + 1]
        while b < end:
            c = orders.crossing[b]
            if heeded.robots[c, 0] == robot:
                if _is_idle(orders, times, heeded, come, robot, c):
                    heeded.robots[c, 0] = NOBODY
                else:
                    other = heeded.robots[c, 1]
                    if come[other] < orders.passed[b]:
                        behind[robot], waiter[other] = waiter[other], robot
                        break
                    passed = min(orders.passed[b], orders.length[other])
                    earlier = _shift_before(times, other, passed)
                    then = earlier + orders.other_comes[b] - orders.comes[b]
                    if then > times.last[robot]:
                        times.bars[delays, 0], times.bars[delays, 1] = b, times.final[robot]
                        times.delays[delays, 0], times.delays[delays, 1] = orders.place[b], then
                        times.last[robot], times.final[robot] = then, delays
                        delays += 1
            b += 1
        times.reached[robot] = b
        if b == end:
            come[robot] = np.inf if orders.vanishes[robot] else orders.length[robot]
        else:
            come[robot] = max(come[robot], orders.place[b] - orders.short[robot])
        one = waiter[robot]
        waiter[robot] = -1
        while one >= 0:
            following = behind[one]
            if come[robot] < orders.passed[times.reached[one]]:
                behind[one], waiter[robot] = waiter[robot], one
            elif not is_ready[one]:
                is_ready[one] = True
                ready[top] = one
                top += 1
            one = following
    for robot in range(count):
        if times.reached[robot] < orders.first[robot + 1] and not fixed[robot]:
            times.stuck[robot] = times.reached[robot]
    return times


@kernel
def order_times(
    orders: PackedOrders, leaders: Ints, progress: Floats, head: Ints, fixed: Flags, begin: Floats
) -> OrderTimes:
    """When robots pass their bars, by what is known now, and which of them never do.

    Inertia is left out: this is a lower bound for robots that drive as fast as they may.

    Args:
        orders: PackedOrders.
        leaders: Who passes each crossing first, (c,).
        progress: How far each robot has come [m], (n,).
        head: The first bar of each robot that may not be open, (n,).
        fixed: Whether a robot never gets on any more, (n,).
        begin: When each robot would have set out to be where it is now without waits [s], (n,).
    """
    return new_order_times(orders, leaders, progress, head, fixed, begin)
