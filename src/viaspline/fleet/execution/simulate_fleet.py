"""A fleet that drives its plan while robots are slow, halt and aren't heard."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from viaspline.fleet.execution.delays import Delays, trouble_of
from viaspline.fleet.execution.driven_fleet import DrivenFleet, driven_fleet_of
from viaspline.fleet.execution.driven_law import driven_laws, stretches_of
from viaspline.fleet.execution.fleet_orders import FleetOrders, orders_of
from viaspline.fleet.execution.fleet_run import FleetEvent, FleetRun, swapped_event
from viaspline.fleet.fleet_laws import FleetLaws
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.plan_fleet import PERIODS, plan_fleet
from viaspline.fleet.still_world import check_still
from viaspline.fleet.told_progress import FleetProgress
from viaspline.formats.asked_for import AskedFleet, asked_fleet
from viaspline.handed_in import check_kind, seed_from, time_from
from viaspline.kernels.arrays import Ints
from viaspline.kernels.fleet.fleet_ticks import SWAPPED, WAITS, FleetTicks, fleet_ticks
from viaspline.kernels.fleet.granted_drive import PackedTrouble

SWAPS_S = 1.0
"""Between two looks for orders to swap."""
ROUNDED = 9
"""Digits of a delay [s]; beyond that it is rounding, and would be told as less than none."""
LONGEST_S = 1e5
"""A drive takes no longer than that."""


def simulate_fleet(
    fleet: AskedFleet,
    delays: Delays | None = None,
    plan: FleetPlan | None = None,
    *,
    seed: int = 0,
    step: float = 0.1,
    periods: int = PERIODS,
    progress: FleetProgress | None = None,
) -> FleetRun:
    """Drive a fleet, with robots that are slow, that halt, and that aren't always heard.

    Every robot drives as fast as its law, its trouble and the others let it; they are let into
    crossings as ``FleetNavigator`` does it. Robots that are not served stay at home; those of them
    that have a path, though no law along it, are proven apart from the others as well. Patrols,
    which never end, drive the laps that their plans hold, and stop at their starts.

    Args:
        fleet: What was asked for, or the file in which that stands.
        delays: What goes wrong; nothing if it isn't given.
        plan: Its plan, if there is one already.
        seed: Of all that is random: the same seed makes the same run.
        step: From report to report [s].
        periods: So many the plan holds of patrols that never end, if it isn't given; see
            ``plan_fleet``.
        progress: See ``FleetProgress``; only planning tells of any.

    Among things that move robots keep to the clock: they are where their plans have them.

    Raises:
        GeometryError: An argument is something else, or there are delays among things that move:
            these wait for nobody.

    Example:
        >>> from viaspline.mission.fleet.fleet import Fleet
        >>> fleet = Fleet.model_validate({"separation_m": 1, "fleet": [
        ...     {"name": "a", "route": {"start": [0, 0], "goal": [40, 0]}},
        ...     {"name": "b", "route": {"start": [20, -20], "goal": [20, 20]}},
        ... ]})
        >>> run = simulate_fleet(fleet, Delays(slowed=0.3, halts=1, halts_s=30), seed=4)
        >>> run.reached, run.certificate.separation >= 1.0
        (True, True)
    """
    fleet = asked_fleet(fleet)
    delays = Delays() if delays is None else delays
    check_kind("delays", delays, Delays, "give Delays(slowed=0.3)")
    if plan is not None:
        check_kind("plan", plan, FleetPlan, "give plan_fleet(fleet)")
    step, seed = time_from("step", step), seed_from("seed", seed)
    plan = plan_fleet(fleet, progress=progress, periods=periods) if plan is None else plan
    if plan.fleet.world.moving:
        if delays != Delays():
            check_still(plan.fleet)
        return _by_the_clock(plan)
    run = drive_fleet(driven_fleet_of(plan), delays, seed=seed, step=step)
    if plan.patrols is None:
        return run
    ends = {name: late for name, late in run.delays.items() if name not in plan.patrols.begins}
    return replace(run, delays=ends)


def _by_the_clock(plan: FleetPlan) -> FleetRun:
    """A drive in which every robot is just where its plan has it."""
    arrivals = {name: one.trajectory.end_time for name, one in plan.plans.items()}
    events = [
        FleetEvent("arrived", time, name, f"{name} arrives") for name, time in arrivals.items()
    ]
    return FleetRun(
        arrivals=arrivals,
        delays=dict.fromkeys(arrivals, 0.0),
        events=tuple(sorted(events, key=lambda event: (event.time, event.name))),
        deadlock=(),
        courses=plan.courses,
        laws=plan.laws,
        required=plan.fleet.separation_m,
        end_s=max(arrivals.values(), default=0.0),
        by_clock={name: one.trajectory for name, one in plan.plans.items()},
    )


def drive_fleet(
    fleet: DrivenFleet,
    delays: Delays | None = None,
    *,
    orders: FleetOrders | None = None,
    seed: int = 0,
    step: float = 0.1,
    swaps: bool = True,
) -> FleetRun:
    """Drive a fleet by its orders: each robot as fast as its law and the others let it.

    A robot doesn't wait for a time of the plan, but for the robots that are to pass before it. So
    it may be earlier than planned. It never sets out before it departs.

    Args:
        fleet: With its plan.
        delays: What goes wrong; nothing if it isn't given.
        orders: Of the fleet; drawn up if they aren't given.
        seed: Of all that is random.
        step: From report to report [s].
        swaps: Whether orders that a delay has made foolish are swapped.

    Raises:
        GeometryError: The laws of the plan keep no order, or one with a cycle.
    """
    orders = orders_of(fleet) if orders is None else orders
    delays = Delays() if delays is None else delays
    trouble = trouble_of(delays, fleet, seed)
    rides = fleet.rides
    begin = float(rides.depart.min(initial=math.inf))
    begin = begin if math.isfinite(begin) else 0.0
    longest = int(_longest(fleet, delays, trouble, begin) / step) + 1
    every = max(round(SWAPS_S / step), 1) if swaps else 0
    ticks = fleet_ticks(
        fleet.courses.packed, rides, fleet.alone, orders.packed, orders.leaders, trouble,
        begin, step, longest, every,
    )  # fmt: skip
    return _run(fleet, ticks)


def _longest(fleet: DrivenFleet, delays: Delays, trouble: PackedTrouble, begin: float) -> float:
    """How long a drive can take if no robot waits for one that waits for it [s]."""
    ends = fleet.courses.packed.first[1:] - 1
    is_timed = fleet.laws.packed.is_timed
    planned = fleet.laws.packed.arrive[ends][is_timed].max(initial=begin) - begin
    slower = 1.0 / (1.0 - delays.slowed) / (1.0 - delays.lost)
    alone = fleet.alone.leave[ends].sum()
    return float(min(60.0 + 10.0 * slower * planned + alone + trouble.halts.sum(), LONGEST_S))


def _run(fleet: DrivenFleet, ticks: FleetTicks) -> FleetRun:
    """What was driven; robots that have no law stood at their starts."""
    packed, is_timed = fleet.courses.packed, fleet.laws.packed.is_timed
    came = np.isfinite(ticks.arrived)
    ends = packed.first[1:] - 1
    planned = fleet.laws.packed.arrive[ends] + fleet.rides.stays[ends]
    late = np.subtract(ticks.arrived, planned, out=np.zeros(len(came)), where=came)
    late = np.round(late, ROUNDED) + 0.0
    leaves = np.where(fleet.rides.vanishes & came, ticks.arrived, np.inf)
    stretches = stretches_of(ticks, np.where(is_timed, fleet.rides.depart, 0.0))
    courses, laws = driven_laws(fleet.courses, stretches, ticks.place, leaves)
    _stand_for_ever(courses.packed.first, laws, np.flatnonzero(~is_timed))
    arrivals = {fleet.names[r]: float(ticks.arrived[r]) for r in np.flatnonzero(came)}
    return FleetRun(
        arrivals=arrivals,
        delays={fleet.names[r]: float(late[r]) for r in np.flatnonzero(came)},
        events=_events(fleet.names, ticks),
        deadlock=tuple(fleet.names[r] for r in np.flatnonzero(~came & is_timed)),
        courses=courses,
        laws=laws,
        required=fleet.separation,
        end_s=ticks.end,
    )


def _stand_for_ever(first: Ints, laws: FleetLaws, robots: Ints) -> None:
    """Robots stand where they are since ever: their laws are written to.

    Args:
        first: The first node of each robot, (n + 1,).
        laws: Of all that was driven.
        robots: Which of them never did, (k,).
    """
    for robot in robots.tolist():
        nodes = slice(int(first[robot]), int(first[robot + 1]))
        laws.packed.arrive[nodes] = -np.inf
        laws.packed.leave[nodes] = np.inf


def _events(names: tuple[str, ...], ticks: FleetTicks) -> tuple[FleetEvent, ...]:
    """What happened, in the order of time."""
    events = [
        FleetEvent("arrived", float(ticks.arrived[r]), names[r], f"{names[r]} arrives")
        for r in np.flatnonzero(np.isfinite(ticks.arrived))
    ]
    for kind, time, robot, other, place in ticks.happened.tolist():
        name, other_name = names[int(robot)], names[int(other)]
        if kind == SWAPPED:
            events.append(swapped_event(name, other_name, time))
        elif kind == WAITS:
            words = f"{name} waits at {place:.1f} m for {other_name}"
            events.append(FleetEvent("waits", time, name, words, other_name, place))
        else:
            words = f"{name} goes on at {place:.1f} m"
            events.append(FleetEvent("goes on", time, name, words, None, place))
    return tuple(sorted(events, key=lambda event: (event.time, event.name, event.kind)))
