"""Robots that are where they weren't let to: others let them pass first, if they still can.

Tested through ``fleet/execution/test_strayed_robots``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Ints
from viaspline.kernels.fleet.open_bars import open_bars_of
from viaspline.kernels.fleet.order_swaps import NO_BAR, bars_of_pair, makes_cycle, swap_or_ask
from viaspline.kernels.fleet.packed_dispatch import PackedDispatch
from viaspline.kernels.fleet.packed_orders import PackedOrders
from viaspline.kernels.jit import inner, kernel


@inner
def lets_pass(orders: PackedOrders, dispatch: PackedDispatch, bar: int, now: float) -> bool:
    """Let a robot beyond a bar pass before the other one, or ask that one whether it still can.

    Args:
        orders: PackedOrders.
        dispatch: It is written to.
        bar: Beyond which the robot may be.
        now: [s].

    Returns:
        Whether the robot passes first now.
    """
    leader, crossing = orders.other[bar], orders.crossing[bar]
    side = 1 if orders.robots[crossing, 0] == leader else 0
    entry, final = bars_of_pair(orders, leader, crossing)
    if entry == NO_BAR or not orders.may_lead[crossing, side]:
        return False
    if dispatch.progress[leader] > orders.place[entry]:
        return False
    if makes_cycle(orders, dispatch, crossing, leader, entry, final):
        return False
    return swap_or_ask(orders, dispatch, crossing, leader, entry, now)


@kernel
def let_strayed_pass(
    orders: PackedOrders, dispatch: PackedDispatch, noise: float, now: float
) -> Ints:
    """Let robots that may be beyond their bars pass first where that makes no cycle.

    Args:
        orders: PackedOrders.
        dispatch: It is written to.
        noise: By so much a robot may be beyond a bar without being taken to be [m].
        now: [s].

    Returns:
        Rows of a robot and a bar beyond which it may be, though another is to pass before it, of
        robots that get on, (k, 2).
    """
    found = []
    for robot in range(orders.length.size):
        if dispatch.fixed[robot]:
            continue
        open_bars_of(orders, dispatch, robot)
        b, end = dispatch.head[robot], orders.first[robot + 1]
        while b < end and orders.place[b] + noise < dispatch.promised[robot]:
            other = orders.other[b]
            is_open = (
                dispatch.leaders[orders.crossing[b]] != other
                or dispatch.progress[other] >= orders.passed[b]
            )
            is_shut = not is_open and not dispatch.fixed[other]
            if is_shut and not lets_pass(orders, dispatch, b, now):
                found.append((robot, b))
            b += 1
    rows = np.empty((len(found), 2), np.int64)
    for k in range(len(found)):
        rows[k, 0], rows[k, 1] = found[k]
    return rows
