"""How far robots may go: up to the first bar that the other one hasn't opened.

Tested through ``fleet/execution/test_fleet_navigator``.
"""

from __future__ import annotations

from viaspline.kernels.fleet.packed_dispatch import PackedDispatch
from viaspline.kernels.fleet.packed_orders import PackedOrders
from viaspline.kernels.jit import inlined, kernel


@inlined
def open_bars_of(orders: PackedOrders, dispatch: PackedDispatch, robot: int) -> float:
    """Move on to the first bar of a robot that isn't open, and say how far it may go [m]."""
    b, end = dispatch.head[robot], orders.first[robot + 1]
    while b < end:
        other = orders.other[b]
        if (
            dispatch.leaders[orders.crossing[b]] == other
            and dispatch.progress[other] < orders.passed[b]
        ):
            break
        b += 1
    dispatch.head[robot] = b
    place = orders.place[b] if b < end else orders.length[robot]
    return min(place, orders.length[robot])


@kernel
def open_bars(orders: PackedOrders, dispatch: PackedDispatch) -> None:
    """Move on to the first bar of every robot that isn't open."""
    for robot in range(orders.length.size):
        open_bars_of(orders, dispatch, robot)
