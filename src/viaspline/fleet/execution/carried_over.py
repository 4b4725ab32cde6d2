"""What a fleet under way keeps when it gets another plan: who keeps its path goes on.

Tested through ``fleet/execution/test_changed_fleets``.
"""

from __future__ import annotations

from collections.abc import Set
from dataclasses import replace

import numpy as np

from viaspline.errors import GeometryError
from viaspline.fleet.crossings import FleetCrossings, with_boxes_of
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.fleet_orders import (
    FleetOrders,
    check_settled,
    drawn_orders,
    laws_order,
)
from viaspline.fleet.execution.fleet_progress import FleetProgressState
from viaspline.fleet.execution.fleet_run import swapped_events
from viaspline.fleet.execution.grown_fleet import GrownFleet
from viaspline.fleet.execution.grown_orders import grown_orders
from viaspline.fleet.execution.opened_rings import without_rings
from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.open_bars import open_bars
from viaspline.kernels.fleet.packed_dispatch import PackedDispatch
from viaspline.kernels.fleet.packed_orders import PackedOrders

KEPT = (
    "speeds", "heard", "arrived", "silent", "out", "places", "paths", "stations", "stands",
    "stops_at", "sets_out", "driven", "doubted",
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
    leaders, by_second = _same_orders(state, before, after, kept)
    check_settled(after, leaders)
    drawn = drawn_orders(after, leaders, by_second, np.full(len(after.names), short))
    return _begun(state, before, after, kept, drawn)


def carried_with(
    state: FleetProgressState, before: DrivenFleet, grown: GrownFleet, short: float
) -> FleetProgressState:
    """The state of a fleet with a robot that has a new path; see ``carried_over``.

    Args:
        state: Without that path.
        before: What was driven.
        grown: What is driven now.
        short: How far before a bar each robot may stand and be believed to be farther back [m].

    Raises:
        GeometryError: As for ``carried_over``.
    """
    kept = np.arange(len(grown.fleet.names))
    kept[grown.robot] = -1
    drawn = grown_orders(state, grown, np.full(len(kept), short))
    return _begun(state, before, grown.fleet, kept, drawn)


def _begun(
    state: FleetProgressState, before: DrivenFleet, after: DrivenFleet, kept: Ints,
    drawn: FleetOrders,
) -> FleetProgressState:  # fmt: skip
    """The state of a fleet with another plan, if its orders have no cycle.

    Args:
        state: Under the plan before.
        before: That plan.
        after: The other one.
        kept: For each robot its number before if its path is the same, else -1, (n,).
        drawn: Who passes each crossing first.
    """
    progress = np.where(kept >= 0, state.packed.progress[kept], 0.0)
    promised = np.where(kept >= 0, state.packed.promised[kept], 0.0)
    fixed = (kept >= 0) & state.packed.fixed[kept]
    orders = without_rings(drawn, after.rides.depart, progress, fixed, promised)
    new = FleetProgressState.at_start(after, orders)
    packed = new.packed
    robots = np.flatnonzero(kept >= 0)
    for now, was in zip(packed[1:], state.packed[1:], strict=True):
        now[robots] = was[kept[robots]]
    for name in KEPT:
        getattr(new, name)[robots] = getattr(state, name)[kept[robots]]
    packed.head[:] = orders.packed.first[:-1]
    packed.recall[:] = -1
    packed.recall_place[:] = np.inf
    _begin_anew(new, state, before, kept)
    packed.begin[kept < 0] = np.maximum(packed.begin[kept < 0], state.time)
    open_bars(orders.packed, packed)
    check_let_in(orders, packed, kept, _strayed(state))
    swapped = swapped_events(after.names, drawn.leaders, orders.leaders, max(state.time, 0.0))
    return replace(new, time=state.time, events=(*state.events, *swapped), no_ways=state.no_ways)


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
            if _is_same(d0, d1) and _is_same(p0, p1):
                kept[robot] = old
    return kept


def _is_same(one: Floats, other: Floats) -> bool:
    """Whether two rows of places are one but for rounding; mostly they are the very same."""
    if one.shape != other.shape:
        return False
    return bool((one == other).all()) or np.allclose(one, other, rtol=0.0, atol=SAME_M)


def _same_orders(
    state: FleetProgressState, before: DrivenFleet, after: DrivenFleet, kept: Ints
) -> tuple[Ints, Flags]:
    """Who passes each crossing first, and by whose boxes: as it was, else by the laws."""
    new, old = _same_crossings(before, after, kept)
    was = state.packed.leaders[old]
    new, old, was = new[was >= 0], old[was >= 0], was[was >= 0]
    is_open = np.ones(len(after.crossings.packed.robots), np.bool_)
    is_open[new] = False
    crossings = with_boxes_of(after.crossings.packed, is_open)
    leaders, by_second = laws_order(replace(after, crossings=FleetCrossings(crossings)))
    number = np.full(len(before.names), -1)
    number[kept[kept >= 0]] = np.flatnonzero(kept >= 0)
    leaders[new] = number[was]
    by_second[new] = (was != state.orders.leaders[old]) | state.orders.by_second[old]
    return leaders, by_second


def _same_crossings(before: DrivenFleet, after: DrivenFleet, kept: Ints) -> tuple[Ints, Ints]:
    """Crossings of robots that keep their paths, and what their numbers were before, (k,) each."""
    old, new = before.crossings.packed, after.crossings.packed
    is_kept = np.zeros(len(before.names), np.bool_)
    is_kept[kept[kept >= 0]] = True
    olds = np.flatnonzero(is_kept[old.robots].all(axis=1))
    news = np.flatnonzero((kept[new.robots] >= 0).all(axis=1))
    was = _keys(old.robots[olds], old.span[olds])
    now = _keys(kept[new.robots[news]], new.span[news])
    if np.array_equal(was, now):  # so it is where no robot's number changes
        return news, olds
    known = dict(zip(map(tuple, was.tolist()), olds.tolist(), strict=True))
    number = np.array([known.get(tuple(key), -1) for key in now.tolist()], np.int64)
    return news[number >= 0], number[number >= 0]


def _keys(robots: Ints, span: Floats) -> Floats:
    """What tells a crossing from others: its robots, the lower one first, and its place, (k, 6)."""
    is_turned = robots[:, 0] > robots[:, 1]
    pairs = np.where(is_turned[:, None], robots[:, ::-1], robots)
    ends = np.where(is_turned[:, None], span[:, [2, 3, 0, 1]], span)
    return np.column_stack((pairs, np.round(ends / SAME_M / 10.0)))


def let_in_too_early(
    orders: FleetOrders, promised: Floats, progress: Floats, fixed: Flags
) -> dict[int, int]:
    """Crossings into which the robot that is to pass second has been let already, by which one.

    Args:
        orders: Who passes first where.
        promised: The farthest that each robot may take to be granted [m], (n,).
        progress: How far each has come at least [m], (n,).
        fixed: Whether each never gets on any more: it may be where others were let in, (n,).
    """
    packed = orders.packed
    bars, robots = _passed_too_early(packed, orders.leaders, promised, progress, packed.first[:-1])
    drives = ~fixed[packed.other[bars]]
    bars, robots = bars[drives], robots[drives]
    return dict(zip(packed.crossing[bars].tolist(), robots.tolist(), strict=True))


def _strayed(state: FleetProgressState) -> set[tuple[int, int]]:
    """Robots that may be beyond bars, and who is to pass before them there: they strayed."""
    packed, orders = state.packed, state.orders.packed
    bars, robots = _passed_too_early(
        orders, packed.leaders, packed.promised, packed.progress, packed.head
    )
    return set(zip(robots.tolist(), orders.other[bars].tolist(), strict=True))


def _passed_too_early(
    packed: PackedOrders, leaders: Ints, promised: Floats, progress: Floats, head: Ints
) -> tuple[Ints, Ints]:
    """The bars beyond which robots have been let before those that are to pass first, and whom.

    Bars before ``head`` are open, (n,).
    """
    ends = packed.first[1:]
    here = np.flatnonzero(np.isfinite(progress) & (head < ends))
    here = here[packed.place[head[here]] < promised[here]].tolist()
    let = [
        np.arange(head[r], head[r] + np.searchsorted(packed.place[head[r] : ends[r]], promised[r]))
        for r in here
    ]
    bars: Ints = np.concatenate([np.empty(0, np.int64), *let])
    robot = np.repeat(here, [one.size for one in let]).astype(np.int64)
    late = leaders[packed.crossing[bars]] == packed.other[bars]
    late &= promised[robot] > packed.place[bars] + SAME_M
    late &= progress[packed.other[bars]] < packed.passed[bars]
    return bars[late], robot[late]


def check_let_in(
    orders: FleetOrders, dispatch: PackedDispatch, kept: Ints, strayed: Set[tuple[int, int]]
) -> None:
    """Refuse a leader of a crossing into which the other robot has been let already.

    A robot may be beyond where it was let, for it strayed or died there, and in the way of one that
    is to pass before it: among those that keep their paths nothing is changed by that.

    Args:
        orders: Who passes first where.
        dispatch: How far robots have come and may go. Who has left the world is in nobody's way
            whatever it was let into.
        kept: For each robot its number before if its path is the same, else -1, (n,).
        strayed: Of whom that was so before already, with whom, by their numbers before.

    Raises:
        GeometryError: With who was to pass before whom.
    """
    packed = orders.packed
    bars, robots = _passed_too_early(
        packed, orders.leaders, dispatch.promised, dispatch.progress, dispatch.head
    )
    others = packed.other[bars]
    is_old = dispatch.fixed[robots] | dispatch.fixed[others]
    is_old &= (kept[robots] >= 0) & (kept[others] >= 0)
    pairs = zip(kept[robots].tolist(), kept[others].tolist(), strict=True)
    is_old |= np.array([pair in strayed for pair in pairs], np.bool_)
    bars, robots = bars[~is_old], robots[~is_old]
    if bars.size:
        b = int(bars[0])
        first, second = orders.names[packed.other[b]], orders.names[int(robots[0])]
        raise GeometryError(
            f"{first} is to pass before {second}, which may have gone beyond "
            f"{packed.place[b]:.1f} m already; plan {first} so that it passes after {second}"
        )
