"""A fleet's plan: paths first, then who passes when, then the proof."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from viaspline.errors import GeometryError
from viaspline.fleet.courses import FleetCourses
from viaspline.fleet.crossing_paths import CrossingPaths, crossing_paths
from viaspline.fleet.crossings import FleetCrossings
from viaspline.fleet.fleet_certificate import certify_fleet
from viaspline.fleet.fleet_plan import FleetPlan, NotServed
from viaspline.fleet.precedences import precedences_of
from viaspline.fleet.timing.improve_laws import improve_laws
from viaspline.fleet.timing.rides import FleetRides, rides_of
from viaspline.fleet.timing.time_paths import Timing, time_paths
from viaspline.fleet.timing.timed_trajectory import timed_trajectory
from viaspline.handed_in import check_callable, check_kind, number_from
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.planner import Plan

FleetProgress = Callable[[str, float], None]
"""Called with what is being done, and the share of it that is done."""


@dataclass(frozen=True, eq=False)
class TimedFleet:
    """Robots with paths, and when they drive along them.

    Attributes:
        members: Those that have a path.
        plans: Their paths, with the laws of robots that are alone, in the order of the members.
        courses: These paths, cut into cells.
        crossings: Where they come near each other.
        rides: How each robot drives alone.
        timing: When it drives among the others.
    """

    members: tuple[FleetMember, ...]
    plans: tuple[Plan, ...]
    courses: FleetCourses
    crossings: FleetCrossings
    rides: FleetRides
    timing: Timing

    @classmethod
    def of(cls, fleet: Fleet, paths: CrossingPaths) -> TimedFleet:
        """Time robots along their paths.

        Args:
            fleet: What is asked for.
            paths: Of those that have one.
        """
        courses, crossings = paths.courses, paths.crossings
        members = [one for one in fleet.members if one.name in paths.laid.plans]
        plans = [paths.laid.plans[one.name] for one in members]
        rides = rides_of(members, plans, courses)
        priorities = [one.priority for one in members]
        timing = time_paths(courses, crossings, rides, priorities)
        return cls(tuple(members), tuple(plans), courses, crossings, rides, timing)

    @property
    def blocked(self) -> tuple[FleetMember, ...]:
        """The robots that could not be timed."""
        return tuple(self.members[k] for k in sorted(self.timing.blocked))


def plan_fleet(
    fleet: Fleet,
    improve: float = 0.0,
    progress: FleetProgress | None = None,
    paths: CrossingPaths | None = None,
) -> FleetPlan:
    """Plan a fleet: a path for each robot, when it drives along it, and the proof of both.

    Each path is laid by itself, round the places where others rest. Then robots are timed along
    their paths by priority and by the orders that are forced: who comes second to a crossing is
    slowed down for it. No path passes another's resting place? Then all are served.

    Args:
        fleet: What is asked for.
        improve: For so long sooner orders are sought [s, on the reference machine].
        progress: See ``FleetProgress``.
        paths: Of the very fleet, if they are laid already.

    Returns:
        The plans of those that are served, proven apart, and why the others are not.

    Raises:
        GeometryError: ``improve`` is no finite number of 0 or more.

    Example:
        >>> fleet = Fleet.model_validate({"separation_m": 1, "fleet": [
        ...     {"name": "a", "route": {"start": [0, 0], "goal": [40, 0]}},
        ...     {"name": "b", "route": {"start": [20, -20], "goal": [20, 20]}},
        ... ]})
        >>> plan = plan_fleet(fleet)
        >>> plan.served, plan.certificate.separation >= 1.0
        (True, True)
        >>> [(one.first, one.second) for one in plan.precedences]
        [('a', 'b')]
    """
    check_kind("fleet", fleet, Fleet, "give Fleet.model_validate({...}) or load(file)")
    improve = number_from("improve", improve)
    if not 0.0 <= improve < math.inf:
        raise GeometryError(f"improve is {improve}; give a finite number of seconds, 0 or more")
    if progress is not None:
        check_callable("progress", progress, "give a function of words and a share")

    def tell(stage: str, share: float) -> None:
        if progress is not None:
            progress(stage, share)

    if paths is None:
        paths = crossing_paths(fleet, lambda done, of: tell("laying paths", done / of))
    tell("timing", 0.0)
    timed = TimedFleet.of(fleet, paths)
    if improve > 0.0:
        improve_laws(
            timed.courses, timed.crossings, timed.rides, timed.timing,
            np.array([one.priority for one in timed.members], float), improve,
            lambda share: tell("improving", share),
        )  # fmt: skip
    tell("proving", 0.0)
    return _planned(fleet, timed, paths.laid.not_served)


def _planned(fleet: Fleet, timed: TimedFleet, not_served: Sequence[NotServed]) -> FleetPlan:
    """The plan of a fleet that is timed."""
    blocked = timed.timing.blocked
    laws = timed.timing.laws
    plans = {
        member.name: replace(
            plan,
            trajectory=timed_trajectory(plan.trajectory, timed.courses, timed.rides, laws, k),
        )
        for k, (member, plan) in enumerate(zip(timed.members, timed.plans, strict=True))
        if k not in blocked
    }
    names = timed.courses.names
    unserved = [
        NotServed(
            names[robot], "gave up",
            f"it can't be timed along its path: '{names[other]}' is in its way",
            f"give '{names[other]}' another start, goal or priority, or let it leave",
        )
        for robot, other in sorted(blocked.items())
    ]  # fmt: skip
    return FleetPlan(
        fleet=fleet,
        plans=plans,
        not_served=(*not_served, *unserved),
        certificate=certify_fleet(timed.courses, laws, fleet.separation_m),
        precedences=precedences_of(timed.courses, timed.crossings, laws, timed.rides.laws),
        alone=dict(zip(names, timed.rides.alone.tolist(), strict=True)),
        courses=timed.courses,
        crossings=timed.crossings,
        laws=laws,
    )
