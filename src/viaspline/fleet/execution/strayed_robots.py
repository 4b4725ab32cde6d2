"""Robots that report where they weren't let to, or are farther back than they were.

A cart that overshoots is in a crossing that another one was to pass first, and one that is pushed
back is in one that others take it to have left. Both are told to stand where they were let in no
more. The other one lets it pass first, if it hasn't come in yet and that makes no cycle. Else it
goes on as it was, if their bodies can't touch, whatever both do by what they were granted: then the
separation isn't kept, and that is said. If they can, it is asked to stop before that as well.

Tested through ``fleet/execution/test_strayed_robots``.
"""

from __future__ import annotations

from collections.abc import Sequence, Set

import numpy as np

from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.fleet_messages import ProgressReport
from viaspline.fleet.execution.fleet_progress import FleetProgressState
from viaspline.fleet.execution.fleet_run import FleetEvent
from viaspline.fleet.execution.judged_reports import NOISE_M
from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.fleet.open_bars import open_bars
from viaspline.kernels.fleet.strayed_passing import let_strayed_pass

SAMPLE_M = 0.02
"""Between two places of a way that are looked at; what lies between is allowed for."""
KEEPS_M = 0.05
"""So long before a place where it might touch another one a robot is asked to stop."""


def overran(
    state: FleetProgressState, fleet: DrivenFleet, robot: int, report: ProgressReport, margin: float
) -> FleetEvent:
    """A robot has come farther than it was let, and may be as far as it needs to stop.

    Args:
        state: It is written to.
        fleet: What is driven.
        robot: Which.
        report: Of where it is.
        margin: How much farther it may be [m].

    Returns:
        What is told of it.
    """
    packed, past = state.packed, float(state.driven[robot])
    may = float(packed.promised[robot])
    words = (
        f"{report.name} says {report.distance + past:.2f} m, but it may go to {may + past:.2f} m "
        "only: it is asked to stand, and others are kept from it where they can be"
    )
    packed.promised[robot] = beyond(fleet, robot, report, margin)
    along = report.distance + past
    return FleetEvent("strayed", state.time, report.name, words, None, along)


def beyond(fleet: DrivenFleet, robot: int, report: ProgressReport, margin: float) -> float:
    """How far a robot gets that stops as soon as it can, at most [m]."""
    stops = 0.5 * report.speed**2 / float(fleet.rides.brake[robot])
    return float(min(report.distance + stops + margin, fleet.lengths[robot]))


def pushed_back(
    state: FleetProgressState, robot: int, report: ProgressReport, margin: float
) -> FleetEvent:
    """A robot is farther back than it was: what it opened by that is shut again.

    Args:
        state: It is written to.
        robot: Which.
        report: Of where it is.
        margin: How much farther back it may be [m].

    Returns:
        What is told of it.
    """
    packed, orders, past = state.packed, state.orders.packed, float(state.driven[robot])
    was, along = float(packed.progress[robot]) + past, report.distance + past
    packed.progress[robot] = max(report.distance - margin, 0.0)
    state.arrived[robot] = False
    shut = (orders.other == robot) & (orders.passed > packed.progress[robot])
    shut &= packed.leaders[orders.crossing] == robot
    waits = np.unique(np.searchsorted(orders.first, np.flatnonzero(shut), side="right") - 1)
    packed.head[waits] = orders.first[waits]
    open_bars(orders, packed)
    ends = np.append(orders.place, np.inf)[packed.head[waits]]
    is_in = (packed.head[waits] < orders.first[waits + 1]) & (ends < packed.promised[waits])
    packed.recalled_at[waits[is_in]] = state.time
    words = (
        f"{report.name} says {along:.2f} m, but it has been at {was:.2f} m: it is taken to be "
        "back, and others are kept from it where they can be"
    )
    return FleetEvent("strayed", state.time, report.name, words, None, along)


def pushed_on(state: FleetProgressState, report: ProgressReport) -> FleetEvent:
    """A robot is farther on than it can have driven, and has said so for long."""
    along = report.distance + float(state.driven[state.orders.names.index(report.name)])
    words = f"{report.name} says {along:.2f} m, where it can't have driven to: it is believed now"
    return FleetEvent("strayed", state.time, report.name, words, None, along)


def hold_apart(
    state: FleetProgressState, fleet: DrivenFleet, margin: float, told: Set[str]
) -> list[FleetEvent]:
    """Let robots that strayed pass first, or others go on past them where they can't touch them.

    Args:
        state: It is written to.
        fleet: What is driven.
        margin: How much farther or less far than it says a robot may be [m].
        told: The robots that have strayed just now: of these events tell.

    Returns:
        Who comes too near to whom.
    """
    packed, orders = state.packed, state.orders.packed
    head, is_shut = packed.head, packed.head < orders.first[1:]
    places = np.append(orders.place, np.inf)[head]
    if not (is_shut & ~packed.fixed & (places + NOISE_M < packed.promised)).any():
        return []
    rows = let_strayed_pass(orders, packed, NOISE_M, state.time)
    crossings = orders.crossing[rows[:, 1]]
    events = []
    for c in np.unique(crossings).tolist():
        bars = rows[crossings == c, 1]
        robot, other = int(rows[crossings == c, 0][0]), int(orders.other[bars[0]])
        near, at = _meet(state, fleet, robot, other, float(orders.passed[bars].max()), margin)
        if near <= 0.0:
            stop = max(float(state.places[other]), at - KEEPS_M - margin)
            packed.halt[other] = min(float(packed.halt[other]), stop)
        if told & {fleet.names[robot], fleet.names[other]}:
            events.append(_told(state, fleet, (robot, other), near, at - margin))
    return events


def _told(
    state: FleetProgressState, fleet: DrivenFleet, pair: Sequence[int], near: float, at: float
) -> FleetEvent:
    """What is told of a robot that strayed and of one that is to pass before it.

    Args:
        state: How far both have come.
        fleet: What is driven.
        pair: The one that may be beyond its bar, and the other.
        near: How much room there is between their bodies at least, or none [m].
        at: Where along its path the other might touch it first [m].
    """
    one, other = (fleet.names[robot] for robot in pair)
    if near > 0.0:
        words = (
            f"{other} passes {one} at {near:.2f} m or more, where {fleet.separation:g} m is asked"
        )
        return FleetEvent("too near", state.time, other, words, one)
    speed = float(state.speeds[pair[1]])
    stops = 0.5 * speed**2 / float(fleet.rides.brake[pair[1]])
    is_late = state.places[pair[1]] + stops + KEEPS_M >= at
    words = f"{other} is asked to stop before {one}, which it might touch"
    if is_late:
        words = f"{other} and {one} may have touched, or may yet: both are asked to stop"
    words += f"; have {one} or {other} back off, or carried off: without({one!r}), dead({one!r})"
    return FleetEvent("too near" if is_late else "stops", state.time, other, words, one)


def _meet(
    state: FleetProgressState, fleet: DrivenFleet, robot: int, other: int, far: float,
    margin: float,
) -> tuple[float, float]:  # fmt: skip
    """How near bodies may come that were kept from being where they are both, at least.

    Args:
        state: How far both have come, and may have been let.
        fleet: What is driven.
        robot: It may be beyond a bar of its own.
        other: It opens that bar.
        far: How far that one has to come for it [m].
        margin: How much farther or less far than it says a robot may be [m].

    Returns:
        The room between their bodies; and how far along its path the other gets before there may
        be none [m].
    """
    reach = fleet.courses.packed.reach
    bodies = float(reach[robot] + reach[other]) - fleet.separation
    begin = float(state.places[robot]) - margin
    stands, error = _sampled(fleet, robot, begin, float(state.packed.promised[robot]))
    way, off = _sampled(fleet, other, float(state.places[other]) - margin, far)
    gaps = _nearest(way[:, 1:], stands[:, 1:]) - bodies - error - off - SAMPLE_M
    touches = np.flatnonzero(gaps <= 0.0)
    at = float(way[touches[0], 0]) if touches.size else np.inf
    return float(gaps.min()), at


def _nearest(places: Floats, others: Floats) -> Floats:
    """How far each place is from the nearest of some others [m], (k,)."""
    return np.array([np.hypot(*(others - one).T).min() for one in places])


def _sampled(fleet: DrivenFleet, robot: int, begin: float, end: float) -> tuple[Floats, float]:
    """Distances along a robot's way and places seen from above, and how far the way is off them.

    Args:
        fleet: What is driven.
        robot: Which.
        begin: From where on [m].
        end: Up to where [m].

    Returns:
        Rows, (k, 3), and the error between them [m].
    """
    nodes, places = fleet.course(robot)
    begin, end = np.clip([begin, max(begin, end)], 0.0, nodes[-1])
    along = np.linspace(begin, end, 2 + int((end - begin) / SAMPLE_M))
    first = fleet.courses.packed.first
    bow = fleet.courses.packed.bow[first[robot] : first[robot + 1]]
    cells: Ints = np.arange(len(nodes))[(nodes <= end) & (np.append(nodes[1:], np.inf) >= begin)]
    rows = np.column_stack((along, *(np.interp(along, nodes, one) for one in places.T[:2])))
    return rows, float(bow[cells].max(initial=0.0))
