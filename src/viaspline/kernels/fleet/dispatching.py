"""From what robots report to how far they may go.

Tested through ``fleet/execution/test_fleet_navigator``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.blocked_times import comes_to, goes_from
from viaspline.kernels.fleet.open_bars import open_bars_of
from viaspline.kernels.fleet.order_flow import expected_shifts
from viaspline.kernels.fleet.order_swaps import consider_swaps, settle_recall
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_dispatch import PackedDispatch
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_orders import PackedOrders
from viaspline.kernels.jit import inner, kernel

MOVED_M = 1e-6
"""A robot that gets on by less stands."""
HELD_M = 1e-3
"""So near the end of what it is granted a robot is held back."""


@inner
def new_dispatch(orders: PackedOrders, leaders: Ints, depart: Floats) -> PackedDispatch:
    """Robots that stand at their starts."""
    count = orders.length.size
    return PackedDispatch(
        leaders.copy(), np.zeros(count), orders.first[:-1].copy(), np.zeros(count),
        np.full(count, -1), np.full(count, np.inf), depart.copy(), depart.copy(),
        np.zeros(count, np.bool_),
    )  # fmt: skip


@kernel
def dispatch_at_start(orders: PackedOrders, leaders: Ints, depart: Floats) -> PackedDispatch:
    """The dispatch of robots that stand at their starts.

    Args:
        orders: PackedOrders.
        leaders: Who passes each crossing first, (c,).
        depart: When each robot sets out [s], (n,).
    """
    return new_dispatch(orders, leaders, depart)


@inner
def take_report(
    courses: PackedCourses, alone: PackedLaws, orders: PackedOrders, dispatch: PackedDispatch,
    robot: int, place: float, holds: float, now: float,
) -> bool:  # fmt: skip
    """Note where a robot is, and whether it keeps before a crossing that it was asked to.

    Args:
        courses: PackedCourses.
        alone: The laws of robots that set out at 0 s and never wait.
        orders: PackedOrders.
        dispatch: It is written to.
        robot: Which.
        place: Where it says it is [m]; infinite: it has left the world.
        holds: How far it takes itself to be let [m]; infinite: it doesn't say.
        now: When it was there [s].

    Returns:
        Whether the order of a crossing was swapped.
    """
    before = dispatch.progress[robot]
    if place > before:
        dispatch.progress[robot] = place
    if place > before + MOVED_M or before >= dispatch.promised[robot] - HELD_M:
        dispatch.moved_at[robot] = max(now, dispatch.moved_at[robot])
    if place < np.inf:
        come = max(comes_to(courses, alone, robot, place), 0.0)
        earliest, latest = now - goes_from(courses, alone, robot, place), now - come
        dispatch.begin[robot] = max(min(dispatch.begin[robot], latest), earliest)
    if holds < np.inf:
        dispatch.promised[robot] = holds
        if dispatch.recall[robot] >= 0:
            return settle_recall(orders, dispatch, robot)
    return False


@inner
def grant_of(orders: PackedOrders, dispatch: PackedDispatch, robot: int) -> float:
    """How far a robot may go now [m]; it is taken to be promised that."""
    grant = min(open_bars_of(orders, dispatch, robot), dispatch.recall_place[robot])
    dispatch.promised[robot] = max(dispatch.promised[robot], grant)
    return grant


@inner
def swap_orders(orders: PackedOrders, dispatch: PackedDispatch, sequence: Ints, now: float) -> int:
    """Swap orders that have become foolish; how many were.

    Args:
        orders: PackedOrders.
        dispatch: It is written to.
        sequence: Bars in an order in which they can be passed, as the leaders are, (m,).
        now: [s].
    """
    shift, _ = expected_shifts(orders, dispatch.leaders, sequence, dispatch.head, dispatch.begin)
    return consider_swaps(orders, dispatch, shift, now)
