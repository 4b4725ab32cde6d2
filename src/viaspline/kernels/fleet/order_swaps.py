"""Orders that a delay has made foolish, swapped.

Where the robot that is to pass first comes so late that the other one had better go first, and
neither is in the crossing yet, nor may take itself to be let into it, the order is swapped; but
only if that leaves the graph of orders without a cycle: if the other one can pass without the first
having to get into the crossing.

Tested through ``fleet/execution/test_simulate_fleet``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.fleet.order_times import OrderTimes, shift_at
from viaspline.kernels.fleet.packed_dispatch import PackedDispatch
from viaspline.kernels.fleet.packed_orders import PackedOrders
from viaspline.kernels.jit import inner

NEAR_S = 4.0
"""A robot that comes to its bar later than this isn't thought about yet."""
GAIN_S = 3.0
"""By so much less the two must be held up in all."""
NO_BAR = -1


@inner
def bars_of_pair(orders: PackedOrders, robot: int, crossing: int) -> tuple[int, int]:
    """The first and the last bar of a robot in a crossing; ``NO_BAR`` if it has none."""
    begin, end = NO_BAR, NO_BAR
    for b in range(orders.first[robot], orders.first[robot + 1]):
        if orders.crossing[b] == crossing:
            if begin == NO_BAR:
                begin = b
            end = b
    return begin, end


@inner
def makes_cycle(
    orders: PackedOrders, dispatch: PackedDispatch, crossing: int, leader: int, entry: int,
    final: int,
) -> bool:  # fmt: skip
    """Whether a robot can't pass a crossing without its leader having to get into it before.

    Nor can it where that needs a robot that never gets on any more.

    Args:
        orders: PackedOrders.
        dispatch: PackedDispatch.
        crossing: In which the order is swapped.
        leader: Who passes it first as yet.
        entry: The first bar of that robot in the crossing.
        final: Its last one there.
    """
    needed = dispatch.progress.copy()  # how far robots have to come
    cursor = dispatch.head.copy()
    stack = np.empty(needed.size, np.int64)
    waits = np.zeros(needed.size, np.bool_)
    second = orders.other[final]
    needed[second] = max(needed[second], orders.passed[final])
    stack[0], top = second, 1
    waits[second] = True
    while top > 0:
        top -= 1
        robot = stack[top]
        waits[robot] = False
        b = cursor[robot]
        while b < orders.first[robot + 1] and orders.place[b] - orders.short[robot] < needed[robot]:
            other, c, passed = orders.other[b], orders.crossing[b], orders.passed[b]
            b += 1
            if c == crossing or dispatch.leaders[c] != other or needed[other] >= passed:
                continue
            needed[other] = passed
            if dispatch.fixed[other]:
                return True
            if other == leader and needed[other] > orders.place[entry] - orders.short[leader]:
                return True
            if not waits[other]:
                waits[other] = True
                stack[top] = other
                top += 1
        cursor[robot] = b
    return False


@inner
def swap(orders: PackedOrders, dispatch: PackedDispatch, crossing: int, leader: int) -> None:
    """Let the other robot of a crossing pass before its leader."""
    one, two = orders.robots[crossing, 0], orders.robots[crossing, 1]
    dispatch.leaders[crossing] = two if one == leader else one
    dispatch.head[leader] = orders.first[leader]  # some of its bars count now
    dispatch.recall[leader] = -1
    dispatch.recall_place[leader] = np.inf


@inner
def swap_or_ask(
    orders: PackedOrders, dispatch: PackedDispatch, crossing: int, leader: int, entry: int,
    now: float,
) -> bool:  # fmt: skip
    """Let the other robot pass first, or ask the leader whether it still keeps out of the crossing.

    One that is asked about another crossing, or that doesn't answer, isn't asked.

    Args:
        orders: PackedOrders.
        dispatch: It is written to.
        crossing: Of two robots.
        leader: It was to pass first, and hasn't come in.
        entry: Its own bar there.
        now: [s].

    Returns:
        Whether the order was swapped.
    """
    if dispatch.promised[leader] <= orders.place[entry]:
        swap(orders, dispatch, crossing, leader)
        return True
    if dispatch.recall[leader] < 0 and dispatch.recalled_at[leader] < np.inf:
        dispatch.recall[leader] = crossing
        dispatch.recall_place[leader] = orders.place[entry]
        dispatch.recalled_at[leader] = now
    return False


@inner
def settle_recall(orders: PackedOrders, dispatch: PackedDispatch, robot: int) -> bool:
    """After a report: the robot keeps before the crossing, or it is let pass as it was.

    Returns:
        Whether the order was swapped.
    """
    crossing = dispatch.recall[robot]
    if dispatch.promised[robot] <= dispatch.recall_place[robot]:
        entry, final = bars_of_pair(orders, robot, crossing)
        if not makes_cycle(orders, dispatch, crossing, robot, entry, final):
            swap(orders, dispatch, crossing, robot)
            return True
    dispatch.recall[robot] = -1
    dispatch.recall_place[robot] = np.inf
    return False


@inner
def consider_swaps(
    orders: PackedOrders, dispatch: PackedDispatch, times: OrderTimes, now: float
) -> int:
    """Swap orders that have become foolish, or ask their leaders to wait so that they can be.

    Args:
        orders: PackedOrders.
        dispatch: It is written to.
        times: When robots are expected to pass their bars.
        now: [s].

    Returns:
        How many orders were swapped.
    """
    swapped = 0
    for robot in range(orders.length.size):
        bar = dispatch.head[robot]
        is_bound = dispatch.fixed[robot] or dispatch.recall[robot] >= 0
        if is_bound or bar == orders.first[robot + 1]:
            continue
        crossing, leader = orders.crossing[bar], orders.other[bar]
        begin = dispatch.begin[robot]
        if begin + orders.comes[bar] > now + NEAR_S or dispatch.recall[leader] >= 0:
            continue
        side = 0 if orders.robots[crossing, 0] == robot else 1
        if not orders.may_lead[crossing, side] or dispatch.fixed[leader]:
            continue
        own_entry, own_final = bars_of_pair(orders, robot, crossing)
        entry, final = bars_of_pair(orders, leader, crossing)
        if own_entry != bar or entry == NO_BAR:
            continue
        if dispatch.progress[leader] > orders.place[entry]:
            continue
        stalled = max(now - dispatch.moved_at[leader], 0.0)
        before = entry - 1
        leads = dispatch.begin[leader]
        if before >= dispatch.head[leader]:
            leads = shift_at(times, leader, before)
        leads = max(leads, dispatch.begin[leader] + stalled)
        held = max(leads + orders.other_comes[own_final] - orders.comes[own_final] - begin, 0.0)
        would = max(begin + orders.other_comes[final] - orders.comes[final] - leads, 0.0)
        if would + GAIN_S > held:
            continue
        if makes_cycle(orders, dispatch, crossing, leader, entry, final):
            continue
        if swap_or_ask(orders, dispatch, crossing, leader, entry, now):
            swapped += 1
    return swapped
