"""What a fleet under way keeps when it gets another plan: who keeps its path goes on.

Tested through ``fleet/execution/test_changed_fleets``.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from viaspline.errors import GeometryError
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.fleet_orders import (
    FleetOrders,
    check_settled,
    laws_order,
    orders_led,
)
from viaspline.fleet.execution.fleet_progress import FleetProgressState
from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.open_bars import open_bars

KEPT = (
    "speeds", "heard", "arrived", "silent", "out", "places", "paths", "stations", "stands",
    "stops_at", "sets_out", "driven",
)  # fmt: skip
"""What a robot that keeps its path keeps of the state, beside what kernels see."""
SAME_M = 1e-6
"""Places that differ by less are one."""


def carried_over(
    state: FleetProgressState, before: DrivenFleet, after: DrivenFleet, short: float
) -> FleetProgressState:
    """The state of a fleet with another plan.

    Args:
        state: Under the plan before.
        before: That plan.
        after: The other one.
        short: How far before a bar each robot may stand and be believed to be farther back [m].

    Raises:
        GeometryError: A robot is to pass before one that may be in the crossing already, or the
            orders have a cycle.
    """
    kept = _kept(before, after)
    leaders, by_second = laws_order(after)
    for c, found in _same_crossings(before, after, kept).items():
        old_leader = int(state.packed.leaders[found])
        if old_leader >= 0:
            number = int(np.flatnonzero(kept == old_leader)[0])
            was_swapped = old_leader != state.orders.leaders[found]
            by_second[c] = was_swapped or bool(state.orders.by_second[found])
            leaders[c] = number
    check_settled(after, leaders)
    progress = np.where(kept >= 0, state.packed.progress[kept], 0.0)
    fixed = (kept >= 0) & state.packed.fixed[kept]
    back = np.full(len(after.names), short)
    orders = orders_led(after, leaders, by_second, back, progress, fixed)
    new = FleetProgressState.at_start(after, orders)
    packed = new.packed
    for robot in np.flatnonzero(kept >= 0):
        old = kept[robot]
        for now, was in zip(packed[1:], state.packed[1:], strict=True):
            now[robot] = was[old]
        for name in KEPT:
            getattr(new, name)[robot] = getattr(state, name)[old]
    packed.head[:] = orders.packed.first[:-1]
    packed.recall[:] = -1
    packed.recall_place[:] = np.inf
    _begin_anew(new, state, before, kept)
    packed.begin[kept < 0] = np.maximum(packed.begin[kept < 0], state.time)
    check_let_in(orders, packed.promised, packed.progress)
    open_bars(orders.packed, packed)
    return replace(new, time=state.time, events=state.events, no_ways=state.no_ways)


def _begin_anew(
    new: FleetProgressState, state: FleetProgressState, before: DrivenFleet, kept: Ints
) -> None:
    """Robots with other paths than before: what they say of the paths before isn't heeded."""
    numbers = {name: robot for robot, name in enumerate(before.names)}
    for robot in np.flatnonzero(kept < 0).tolist():
        old = numbers.get(new.orders.names[robot], -1)
        if old >= 0:
            new.paths[robot] = state.paths[old] + 1
            new.heard[robot] = state.time


def _kept(before: DrivenFleet, after: DrivenFleet) -> Ints:
    """For each robot its number before if its path is the same, else -1, (n,)."""
    numbers = {name: robot for robot, name in enumerate(before.names)}
    kept = np.full(len(after.names), -1)
    for robot, name in enumerate(after.names):
        old = numbers.get(name, -1)
        if old >= 0:
            (d0, p0), (d1, p1) = before.course(old), after.course(robot)
            same = d0.shape == d1.shape and np.allclose(d0, d1, rtol=0.0, atol=SAME_M)
            if same and np.allclose(p0, p1, rtol=0.0, atol=SAME_M):
                kept[robot] = old
    return kept


def _same_crossings(before: DrivenFleet, after: DrivenFleet, kept: Ints) -> dict[int, int]:
    """Crossings of robots that keep their paths, and what their numbers were before."""

    def key(pair: list[int], span: Floats) -> tuple[object, ...]:
        ends = span.reshape(2, 2) if pair[0] < pair[1] else span.reshape(2, 2)[::-1]
        return (*sorted(pair), *np.round(ends.ravel() / SAME_M / 10.0).tolist())

    old = before.crossings.packed
    known = {key(old.robots[c].tolist(), old.span[c]): c for c in range(len(old.robots))}
    new, found = after.crossings.packed, {}
    for c, pair in enumerate(new.robots.tolist()):
        was = [int(kept[robot]) for robot in pair]
        if min(was) >= 0:
            number = known.get(key(was, new.span[c]))
            if number is not None:
                found[c] = number
    return found


def let_in_too_early(orders: FleetOrders, promised: Floats, progress: Floats) -> dict[int, int]:
    """Crossings into which the robot that is to pass second has been let already, by which one.

    Args:
        orders: Who passes first where.
        promised: The farthest that each robot may take to be granted [m], (n,).
        progress: How far each has come at least [m], (n,).
    """
    bars, robots = _passed_too_early(orders, promised, progress)
    return dict(zip(orders.packed.crossing[bars].tolist(), robots.tolist(), strict=True))


def _passed_too_early(
    orders: FleetOrders, promised: Floats, progress: Floats
) -> tuple[Ints, Ints]:  # fmt: skip
    """The bars beyond which robots have been let before those that are to pass first, and whom."""
    packed = orders.packed
    robot = np.repeat(np.arange(len(orders.names)), np.diff(packed.first))
    counts = orders.leaders[packed.crossing] == packed.other
    is_here = np.isfinite(progress)[robot]
    late = counts & is_here & (promised[robot] > packed.place + SAME_M)
    bars = np.flatnonzero(late & (progress[packed.other] < packed.passed))
    return bars, robot[bars]


def check_let_in(orders: FleetOrders, promised: Floats, progress: Floats) -> None:
    """Refuse a leader of a crossing into which the other robot has been let already.

    Args:
        orders: Who passes first where.
        promised: The farthest that each robot may take to be granted [m], (n,).
        progress: How far each has come at least [m], (n,); inf for one that has left the world, and
            is in nobody's way whatever it was let into.

    Raises:
        GeometryError: With who was to pass before whom.
    """
    packed = orders.packed
    bars, robots = _passed_too_early(orders, promised, progress)
    if bars.size:
        b = int(bars[0])
        first, second = orders.names[packed.other[b]], orders.names[int(robots[0])]
        raise GeometryError(
            f"{first} is to pass before {second}, which may have gone beyond "
            f"{packed.place[b]:.1f} m already; plan {first} so that it passes after {second}"
        )
