"""What each robot of a fleet did when, as it was driven.

Tested through ``report/fleet/test_fleet_run_picture``.
"""

from __future__ import annotations

from viaspline.fleet.execution.fleet_run import FleetEvent, FleetRun
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.timelines import ActivitySpan, Timeline

SHOWN_S = 1e-3
"""Stretches that are no longer aren't told [s]."""


def driven_timelines(plan: FleetPlan, run: FleetRun) -> tuple[Timeline, ...]:
    """What every robot did when, in the order of the plan; late is later than planned.

    Args:
        plan: What was planned.
        run: What was driven.
    """
    events: dict[str, list[FleetEvent]] = {name: [] for name in plan.plans}
    for event in run.events:
        if event.name in events and event.kind in ("waits", "goes on"):
            events[event.name].append(event)
    return tuple(
        Timeline(
            name,
            _stretches(one.trajectory.start_time, events[name], run.arrivals.get(name, run.end_s)),
            run.delays.get(name, 0.0),
        )
        for name, one in plan.plans.items()
    )


def _stretches(begin: float, events: list[FleetEvent], end: float) -> tuple[ActivitySpan, ...]:
    """Driving and waiting one after the other, from when a robot may set out until it arrives."""
    found: list[ActivitySpan] = []
    now, other = begin, ""
    for event in [*events, FleetEvent("goes on", end, "", "")]:
        until = min(max(event.time, now), end)
        if until - now > SHOWN_S:
            lost = until - now if other else 0.0
            found.append(ActivitySpan(now, until, "waits" if other else "drives", other, lost))
        now, other = until, event.other or "" if event.kind == "waits" else ""
    return tuple(found)
