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
from viaspline.kernels.fleet.order_flow import expected_shifts, order_flow
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
    shift = _shifts(state)
    alone, courses, stuck = fleet.alone, fleet.courses.packed, state.stuck(leaves)
    drives = np.flatnonzero(~state.out)
    asked = drives if chosen is None else np.intersect1d(drives, chosen)
    behind_all = _last_arrival(fleet, state, shift) if (stuck[asked] >= 0).any() else 0.0
    old = fleet.laws.packed
    arrive, leave, speed = old.arrive.copy(), old.leave.copy(), old.speed.copy()
    if chosen is None:
        arrive[:], leave[:] = np.inf, np.inf
    for robot in asked.tolist():
        nodes = slice(int(courses.first[robot]), int(courses.first[robot + 1]))
        bars = slice(int(orders.first[robot]), int(orders.first[robot + 1]))
        later = _later(shift, state, robot)
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


def _shifts(state: FleetProgressState) -> Floats:
    """When each robot would have set out to pass a bar when it does, without waits [s], (bars,).

    Whoever never gets on is taken to be carried off: the sequence of the state may end before what
    is behind it, and those who wait there would come never.
    """
    orders, packed, out = state.orders.packed, state.packed, state.packed.fixed
    sequence, head, begin = state.sequence, packed.head, packed.begin
    if out.any():
        gone = np.where(out, np.inf, packed.progress)
        sequence, _ = order_flow(orders, packed.leaders, gone, head, out)
        head, begin = np.where(out, orders.first[1:], head), np.where(out, -np.inf, begin)
    shift: Floats = expected_shifts(orders, packed.leaders, sequence, head, begin)[0]
    return shift


def _last_arrival(fleet: DrivenFleet, state: FleetProgressState, shift: Floats) -> float:
    """When the last robot arrives of those that do [s]."""
    last = [float(_later(shift, state, robot)[-1]) for robot in range(len(fleet.names))]
    ends = fleet.alone.arrive[fleet.courses.packed.first[1:] - 1] + last
    return float(ends[np.isfinite(ends)].max(initial=0.0))


def _later(shift: Floats, state: FleetProgressState, robot: int) -> Floats:
    """How much later than its law alone a robot is after so many of its bars [s], (m + 1,)."""
    first, packed = state.orders.packed.first, state.packed
    own = shift[first[robot] : first[robot + 1]]
    passed = int(packed.head[robot] - first[robot])
    known = np.where(np.arange(len(own)) < passed, packed.begin[robot], own)
    later: Floats = np.maximum.accumulate(np.concatenate(([packed.begin[robot]], known)))
    return later
