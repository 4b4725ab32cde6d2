"""A fleet that drives its plan while robots are slow, halt and aren't heard."""

from __future__ import annotations

import numpy as np

from viaspline.fleet.execution.delays import Delays, trouble_of
from viaspline.fleet.execution.driven_fleet import DrivenFleet
from viaspline.fleet.execution.driven_law import driven_laws
from viaspline.fleet.execution.fleet_orders import FleetOrders, orders_of
from viaspline.fleet.execution.fleet_run import FleetEvent, FleetRun
from viaspline.kernels.arrays import Floats
from viaspline.kernels.fleet.fleet_ticks import ARRIVED, SWAPPED, WAITS, FleetTicks, fleet_ticks

SWAPS_S = 1.0
"""Between two looks for orders to swap."""
LONGEST_S = 1e5
"""So long after the plan's end it is simulated at most."""


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
    rides, first = fleet.rides, fleet.courses.packed.first
    begin = float(rides.depart.min(initial=np.inf)) if len(fleet.names) else 0.0
    planned = fleet.laws.packed.arrive[first[1:] - 1]
    slowest = 1.0 / (1.0 - delays.slowed) / (1.0 - delays.lost)
    span = (planned.max(initial=begin) - begin) * slowest * slowest + trouble.halts.sum()
    longest = int((min(10.0 * span, LONGEST_S) + 60.0) / step)
    every = max(round(SWAPS_S / step), 1) if swaps else 0
    ticks = fleet_ticks(
        fleet.courses.packed, rides, fleet.laws_alone(), orders.packed, orders.leaders, trouble,
        begin, step, longest, every,
    )  # fmt: skip
    came = np.isfinite(ticks.arrived)
    arrivals = {name: float(ticks.arrived[i]) for i, name in enumerate(fleet.names) if came[i]}
    courses, laws = driven_laws(
        fleet.courses,
        _stretches(fleet, ticks),
        ticks.place,
        np.where(rides.vanishes & came, ticks.arrived, np.inf),
    )
    return FleetRun(
        arrivals=arrivals,
        delays={n: t - float(planned[i]) for i, n in enumerate(fleet.names) if came[i]
                for t in (arrivals[n],)},
        events=_events(fleet.names, ticks),
        deadlock=tuple(n for i, n in enumerate(fleet.names) if not came[i]),
        courses=courses,
        laws=laws,
        end_s=ticks.end,
    )  # fmt: skip


def _stretches(fleet: DrivenFleet, ticks: FleetTicks) -> list[Floats]:
    """For each robot when, where and how fast it was where its acceleration changed, (m, 3)."""
    rows = ticks.stretches[np.argsort(ticks.stretches[:, 0], kind="stable")]
    cuts = np.searchsorted(rows[:, 0], np.arange(len(fleet.names) + 1))
    found = []
    for robot in range(len(fleet.names)):
        own = rows[cuts[robot] : cuts[robot + 1], 1:4]
        begin = np.array([[float(fleet.rides.depart[robot]), 0.0, 0.0]])
        last = min(float(ticks.arrived[robot]), ticks.end)
        end = np.array([[last, float(ticks.place[robot]), 0.0]])
        found.append(np.concatenate((begin, own, end)))
    return found


def _events(names: tuple[str, ...], ticks: FleetTicks) -> tuple[FleetEvent, ...]:
    """What happened, in the order of time."""
    happened = [(float(t), float(ARRIVED), i) for i, t in enumerate(ticks.arrived) if t < np.inf]
    events = [FleetEvent("arrived", t, names[i], f"{names[i]} arrives") for t, _, i in happened]
    for kind, time, robot, other, place in ticks.happened:
        name = names[int(robot)]
        if kind == SWAPPED:
            other_name = names[int(other)]
            words = f"{name} passes before {other_name}, which is late"
            events.append(FleetEvent("swapped", time, name, words, other_name))
        elif kind == WAITS:
            other_name = names[int(other)]
            words = f"{name} waits at {place:.1f} m for {other_name}"
            events.append(FleetEvent("waits", time, name, words, other_name, place))
        else:
            events.append(
                FleetEvent("goes on", time, name, f"{name} goes on at {place:.1f} m", None, place)
            )
    return tuple(sorted(events, key=lambda event: (event.time, event.name, event.kind)))
