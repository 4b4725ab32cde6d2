"""From what robots report to how far they may go.

Tested through ``fleet/execution/test_fleet_navigator``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.blocked_times import comes_to, goes_from, node_before
from viaspline.kernels.fleet.granted_drive import PackedTrouble, drive_stretch, new_drive
from viaspline.kernels.fleet.open_bars import open_bars_of
from viaspline.kernels.fleet.order_swaps import consider_swaps, settle_recall
from viaspline.kernels.fleet.order_times import new_order_times
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_dispatch import PackedDispatch
from viaspline.kernels.fleet.packed_laws import PackedLaws
from viaspline.kernels.fleet.packed_orders import PackedOrders
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.jit import inlined, inner, kernel

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
        np.full(count, -1), np.full(count, np.inf), np.zeros(count), depart.copy(), depart.copy(),
        np.zeros(count, np.bool_), depart.copy(), np.full(count, np.inf),
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


@kernel
def dispatch_copy(dispatch: PackedDispatch) -> PackedDispatch:
    """A dispatch of its own that says what another one does."""
    return PackedDispatch(
        dispatch.leaders.copy(), dispatch.progress.copy(), dispatch.head.copy(),
        dispatch.promised.copy(), dispatch.recall.copy(), dispatch.recall_place.copy(),
        dispatch.recalled_at.copy(), dispatch.begin.copy(), dispatch.moved_at.copy(),
        dispatch.fixed.copy(), dispatch.departs.copy(), dispatch.halt.copy(),
    )  # fmt: skip


@inlined
def take_report(
    orders: PackedOrders, dispatch: PackedDispatch, robot: int, place: float, holds: float,
    heard: float, now: float,
) -> bool:  # fmt: skip
    """Note where a robot is, and whether it keeps before a crossing that it was asked to.

    A robot that has been asked to may take itself to be let as far as it says, or as far as it was
    let since: those commands may still be on their way.

    Args:
        orders: PackedOrders.
        dispatch: It is written to.
        robot: Which.
        place: Where it says it is [m]; infinite: it has left the world.
        holds: How far it takes itself to be let [m].
        heard: Of when the last command is that it has heard [s]; minus infinity: it doesn't say.
        now: When it was there [s].

    Returns:
        Whether it says what becomes of a crossing that it was asked to let another pass first.
    """
    before = dispatch.progress[robot]
    if place > before:
        dispatch.progress[robot] = place
    if place > before + MOVED_M or before >= dispatch.promised[robot] - HELD_M:
        dispatch.moved_at[robot] = max(now, dispatch.moved_at[robot])
    is_held = dispatch.recall[robot] >= 0 or dispatch.halt[robot] < np.inf
    if not is_held or heard < dispatch.recalled_at[robot]:
        return False
    let = open_bars_of(orders, dispatch, robot)
    let = min(let, dispatch.recall_place[robot], dispatch.halt[robot])
    dispatch.promised[robot] = max(holds, let)
    return dispatch.recall[robot] >= 0


@inner
def set_begin(
    courses: PackedCourses, alone: PackedLaws, dispatch: PackedDispatch, robot: int, now: float
) -> None:
    """Reckon when a robot would have set out to be where it is now without any waits.

    Args:
        courses: PackedCourses.
        alone: The laws of robots that set out at 0 s and never wait.
        dispatch: It is written to.
        robot: Which.
        now: [s].
    """
    place = dispatch.progress[robot]
    if place < np.inf and not dispatch.fixed[robot]:
        latest = now - max(comes_to(courses, alone, robot, place), 0.0)
        earliest = now - goes_from(courses, alone, robot, place)
        begin = max(min(dispatch.begin[robot], latest), earliest)
        dispatch.begin[robot] = max(begin, dispatch.departs[robot])


@inlined
def grant_of(orders: PackedOrders, dispatch: PackedDispatch, robot: int) -> float:
    """How far a robot may go now [m]; it is taken to be promised that, if it ever gets on."""
    grant = min(open_bars_of(orders, dispatch, robot), dispatch.recall_place[robot])
    grant = min(grant, dispatch.halt[robot])
    if not dispatch.fixed[robot]:
        dispatch.promised[robot] = max(dispatch.promised[robot], grant)
    return grant


@inner
def swap_orders(
    courses: PackedCourses, alone: PackedLaws, orders: PackedOrders, dispatch: PackedDispatch,
    now: float,
) -> int:  # fmt: skip
    """Swap orders that have become foolish; how many were.

    Args:
        courses: PackedCourses.
        alone: The laws of robots that set out at 0 s and never wait.
        orders: PackedOrders.
        dispatch: It is written to.
        now: [s].
    """
    for robot in range(orders.length.size):
        set_begin(courses, alone, dispatch, robot, now)
        open_bars_of(orders, dispatch, robot)
    times = new_order_times(
        orders, dispatch.leaders, dispatch.progress, dispatch.head, dispatch.fixed, dispatch.begin
    )
    return consider_swaps(orders, dispatch, times, now)


@kernel
def dispatch_step(
    courses: PackedCourses, alone: PackedLaws, orders: PackedOrders, dispatch: PackedDispatch,
    robots: Ints, reports: Floats, swaps: bool, now: float,
) -> Floats:  # fmt: skip
    """One step of a fleet that is driven: reports in, grants out.

    Args:
        courses: PackedCourses.
        alone: The laws of robots that set out at 0 s and never wait.
        orders: PackedOrders.
        dispatch: It is written to.
        robots: Who reports, (k,).
        reports: When [s], where it is [m], how far it takes itself to be let [m], and of when the
            last command is that it has heard [s], (k, 4).
        swaps: Whether orders that have become foolish are swapped.
        now: [s].

    Returns:
        How far each robot may go [m], (n,).
    """
    for i in range(robots.size):
        time, place, holds, heard = reports[i]
        if take_report(orders, dispatch, robots[i], place, holds, heard, time):
            settle_recall(orders, dispatch, robots[i])
    count = orders.length.size
    for robot in range(count):
        set_begin(courses, alone, dispatch, robot, now)
    if swaps:
        swap_orders(courses, alone, orders, dispatch, now)
    grants = np.empty(count)
    for robot in range(count):
        grants[robot] = grant_of(orders, dispatch, robot)
    return grants


@kernel
def states_ahead(
    courses: PackedCourses, rides: PackedRides, progress: Floats, speeds: Floats, grants: Floats,
    period: float,
) -> tuple[Floats, Floats]:  # fmt: skip
    """Where robots are after a while and how fast, each as its law and its grant let it.

    Args:
        courses: PackedCourses.
        rides: PackedRides.
        progress: Where they are; infinite: not there any more [m], (n,).
        speeds: How fast they are [m/s], (n,).
        grants: How far they may go [m], (n,).
        period: How long that while is [s].

    Returns:
        The places [m] and the speeds [m/s], (n,).
    """
    nodes = courses.distance.size
    trouble = PackedTrouble(np.ones(nodes), np.zeros(nodes), 0.0, 0)
    drive = new_drive(courses, rides, trouble)
    for robot in range(grants.size):
        first, last = courses.first[robot], courses.first[robot + 1] - 1
        if progress[robot] >= courses.distance[last]:
            drive.place[robot] = courses.distance[last]
            continue
        node = node_before(courses.distance, first, last, progress[robot])
        drive.cell[robot] = node
        drive.place[robot] = progress[robot]
        drive.square[robot] = speeds[robot] ** 2
        drive.rests_until[robot] = 0.0
        drive.served[robot] = True
        time = 0.0
        while time < period and drive.arrived[robot] == np.inf:
            time = drive_stretch(drive, courses, rides, trouble, robot, grants[robot], time, period)
    return drive.place, np.sqrt(drive.square)
