"""Patrols under way that never end: what is known of them, a period later.

The plan of a patrol holds some periods. When all patrols have driven the first of them, and all
others have arrived, the fleet is where it was a period before: every patrol is counted back by what
it drives in a period, and the order in which robots pass a crossing is the one that holds for that
crossing a period later. What comes into sight at the end has the order of the plan.

Tested through ``fleet/execution/test_rolled_over``.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viaspline.fleet.execution.carried_over import let_in_too_early
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.dwells import FleetStations
from viaspline.fleet.execution.fleet_orders import FleetOrders, orders_led
from viaspline.fleet.execution.fleet_progress import FleetProgressState
from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.open_bars import open_bars

SAME_M = 1e-4
"""Places of two periods that differ by less are one."""
SAME_SPAN_M = 0.25
"""Ends of crossings a period apart that differ by less are one: boxes hold centimetres more."""


def rolled_over(
    state: FleetProgressState, fleet: DrivenFleet, stations: FleetStations
) -> FleetProgressState:
    """The state a period later, if patrols have driven one; else the very state.

    A patrol that is dead holds the others up at the end of what is planned.

    Args:
        state: How far the fleet has come.
        fleet: What is driven.
        stations: Its stations.

    Raises:
        GeometryError: The orders that hold have a cycle.
    """
    rounds = fleet.rounds
    if rounds is None:
        return state
    since = np.zeros(len(rounds)) if fleet.lead_ins is None else fleet.lead_ins
    if not _is_over(state, rounds, since):
        return state
    shift = np.where(state.out, 0.0, rounds)
    served = state.stations - _passed(stations, since, since + shift)
    if (served < 0).any():
        return state  # one still stands where its next lap begins, for as long as it has to
    orders = _orders_later(state, fleet, since, shift)
    if orders is None:
        return state
    new = FleetProgressState.at_start(fleet, orders)
    packed = new.packed
    for now, was_there in zip(packed[1:], state.packed[1:], strict=True):
        now[:] = was_there
    packed.progress[:] -= shift
    packed.promised[:] -= shift
    packed.halt[:] -= shift
    packed.begin[:] += _alone(fleet, since + shift) - _alone(fleet, since)
    packed.head[:] = orders.packed.first[:-1]
    packed.recall[:] = -1
    packed.recall_place[:] = np.inf
    open_bars(orders.packed, packed)
    return replace(
        new,
        time=state.time,
        speeds=state.speeds,
        heard=state.heard,
        arrived=state.arrived & (shift == 0.0),
        silent=state.silent,
        out=state.out,
        driven=state.driven + shift,
        places=state.places - shift,
        paths=state.paths,
        stations=served,
        stands=state.stands,
        stops_at=state.stops_at - shift,
        sets_out=state.sets_out,
        doubted=state.doubted - np.column_stack((np.zeros(len(shift)), shift)),
        events=state.events,
    )


def _orders_later(
    state: FleetProgressState, fleet: DrivenFleet, since: Floats, shift: Floats
) -> FleetOrders | None:
    """The orders that hold when all are counted back; None where it is too soon for that.

    Args:
        state: How far the fleet has come.
        fleet: What is driven.
        since: Where the first lap of each robot begins [m], (n,).
        shift: By how much each is counted back [m], (n,).

    Raises:
        GeometryError: The orders have a cycle.
    """
    planned = state.orders.leaders
    leaders, by_second = planned.copy(), state.orders.by_second.copy()
    for c, was in _a_period_later(fleet, since, shift).items():
        leader = int(state.packed.leaders[was])
        if leader >= 0:
            is_planned = leader == planned[was]
            leaders[c] = leader
            by_second[c] = bool(state.orders.by_second[was]) if is_planned else True
    come = state.packed.progress - shift
    short, promised = state.orders.packed.short, state.packed.promised - shift
    fixed = state.packed.fixed
    orders = orders_led(fleet, leaders, by_second, short, come, fixed)
    let_in = let_in_too_early(orders, promised, come, fixed)
    if let_in:  # beyond where the crossing begins in this lap
        for c, robot in let_in.items():
            leaders[c], by_second[c] = robot, True
        orders = orders_led(fleet, leaders, by_second, short, come, fixed)
        if let_in_too_early(orders, promised, come, fixed):
            return None  # both are in it by the wider cells of this lap: later, then
    return orders


def _is_over(state: FleetProgressState, rounds: Floats, since: Floats) -> bool:
    """Whether all patrols have driven a period, and all others have arrived or are gone."""
    progress = state.packed.progress
    is_patrol = rounds > 0.0
    gone = state.out & np.isinf(progress)
    drives = is_patrol & ~gone
    if not drives.any() or (state.out & drives).any() or (state.packed.recall >= 0).any():
        return False
    others = ~is_patrol & ~(state.arrived | state.out)
    return not others.any() and bool((progress >= since + rounds)[drives].all())


def _passed(stations: FleetStations, since: Floats, until: Floats) -> Ints:
    """How many stations each robot has from one place to another, (n,)."""
    counts = np.diff(stations.first)
    inside = (stations.place > np.repeat(since, counts) + SAME_M) & (
        stations.place <= np.repeat(until, counts) + SAME_M
    )
    sums: Ints = np.concatenate(([0], np.cumsum(inside)))
    passed: Ints = np.diff(sums[stations.first])
    return passed


def _a_period_later(fleet: DrivenFleet, since: Floats, shift: Floats) -> dict[int, int]:
    """For each crossing the one of the same robots a period later, where the plan has it.

    What a robot passes before its first lap doesn't come again.
    """
    packed = fleet.crossings
    later: dict[tuple[int, int], list[int]] = {}
    for c, pair in enumerate(packed.robots.tolist()):
        later.setdefault((pair[0], pair[1]), []).append(c)
    found = {}
    for pair, crossings in later.items():
        by = np.repeat(shift[list(pair)], 2)
        spans, begins = packed.span[crossings], since[list(pair)]
        for c in crossings:
            if (packed.span[c, 1::2] < begins).any():
                continue
            off = np.abs(spans - packed.span[c] - by).max(axis=1)
            nearest = int(off.argmin())
            if off[nearest] < SAME_SPAN_M:
                found[c] = crossings[nearest]
    return found


def _alone(fleet: DrivenFleet, places: Floats) -> Floats:
    """When robots that set out at 0 s and never wait come to a place each [s], (n,)."""
    first, alone = fleet.courses.packed.first, fleet.alone
    times = np.zeros(len(places))
    for robot in np.flatnonzero(places > 0.0):
        nodes = slice(int(first[robot]), int(first[robot + 1]))
        along = fleet.courses.packed.distance[nodes]
        times[robot] = np.interp(places[robot], along, alone.arrive[nodes])
    return times
