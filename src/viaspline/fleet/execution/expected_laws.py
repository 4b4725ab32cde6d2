"""When every robot under way will be where, if none is delayed any more.

These are laws that robots can't drive: they come to a bar as fast as they would pass it, and wait.
But they keep every order that holds, so whoever is timed among them fits into the orders: the graph
stays without a cycle.

Tested through ``fleet/execution/test_changed_fleets``.
"""

from __future__ import annotations

import numpy as np

from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.fleet_progress import FleetProgressState
from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.order_times import OrderTimes, order_times
from viaspline.kernels.fleet.packed_laws import PackedLaws


def expected_laws(
    fleet: DrivenFleet, state: FleetProgressState, leaves: int | None = None,
    chosen: Ints | None = None,
) -> PackedLaws:  # fmt: skip
    """The laws of a fleet from now on; of robots that don't drive any more there are none.

    Those who wait for one that never gets on come later than anybody else, but do come: it may be
    carried off. So nobody is let rest in their way.

    Args:
        fleet: What is driven.
        state: How far it has come.
        leaves: A robot that leaves its path where it is: those who wait for it there come later
            than anybody else, but do come, and in the order that they would have.
        chosen: Whose laws are asked for; the others have those that they had, (k,). None: all.
    """
    orders, packed = state.orders.packed, state.packed
    times = _times(state)
    alone, courses, stuck = fleet.alone, fleet.courses.packed, state.stuck(leaves)
    drives = np.flatnonzero(~state.out)
    asked = drives if chosen is None else np.intersect1d(drives, chosen)
    behind_all = _last_arrival(fleet, state, times) if (stuck[asked] >= 0).any() else 0.0
    old = fleet.laws.packed
    arrive, leave, speed = old.arrive.copy(), old.leave.copy(), old.speed.copy()
    if chosen is None:
        arrive[:], leave[:] = np.inf, np.inf
    for robot in asked.tolist():
        nodes = slice(int(courses.first[robot]), int(courses.first[robot + 1]))
        bars = slice(int(orders.first[robot]), int(orders.first[robot + 1]))
        later = _later(times, state, robot)
        if stuck[robot] >= 0:
            later[stuck[robot] - bars.start + 1 :] += behind_all
        along, places = courses.distance[nodes], orders.place[bars]
        comes: Ints = np.searchsorted(places, along, side="left")
        goes: Ints = np.searchsorted(places, along, side="right")
        arrive[nodes] = alone.arrive[nodes] + later[comes]
        leave[nodes] = alone.leave[nodes] + later[goes]
        speed[nodes] = alone.speed[nodes]
        gone = np.flatnonzero(along[1:] <= packed.progress[robot]) + nodes.start
        arrive[gone] = leave[gone] = -np.inf  # who joins may have stood there since ever
        last = nodes.stop - 1
        arrived = arrive[last] + fleet.rides.stays[last]
        leave[last] = arrived if fleet.rides.vanishes[robot] else np.inf
    return PackedLaws(arrive, leave, speed, ~state.out)


def _times(state: FleetProgressState) -> OrderTimes:
    """When robots pass their bars.

    Whoever never gets on is taken to be carried off: those who wait there would come never.
    """
    orders, packed, out = state.orders.packed, state.packed, state.packed.fixed
    head, begin, come = packed.head, packed.begin, packed.progress
    if out.any():
        come = np.where(out, np.inf, come)
        head, begin = np.where(out, orders.first[1:], head), np.where(out, -np.inf, begin)
    return order_times(orders, packed.leaders, come, head, out, begin)


def _last_arrival(fleet: DrivenFleet, state: FleetProgressState, times: OrderTimes) -> float:
    """When the last robot arrives of those that do [s]."""
    last = [float(_later(times, state, robot)[-1]) for robot in range(len(fleet.names))]
    ends = fleet.alone.arrive[fleet.courses.packed.first[1:] - 1] + last
    return float(ends[np.isfinite(ends)].max(initial=0.0))


def _later(times: OrderTimes, state: FleetProgressState, robot: int) -> Floats:
    """How much later than its law alone a robot is after so many of its bars [s], (m + 1,)."""
    first, end = state.orders.packed.first[robot : robot + 2].tolist()
    later = np.full(end + 1 - first, np.inf)
    until, at = int(times.reached[robot]), int(times.final[robot])
    while at >= 0:
        bar, before = times.bars[at].tolist()
        later[bar + 1 - first : until + 1 - first] = times.delays[at, 1]
        until, at = bar, before
    later[: until + 1 - first] = times.begin[robot]
    return later
