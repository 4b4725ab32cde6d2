"""A fleet's plan: paths first, then who passes when, then the proof."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from viaspline.errors import GeometryError
from viaspline.fleet.crossing_paths import CrossingPaths, crossing_paths
from viaspline.fleet.fleet_certificate import certify_fleet
from viaspline.fleet.fleet_plan import FleetPlan, NotServed
from viaspline.fleet.laying.lay_paths import THIS_PROCESS
from viaspline.fleet.laying.laying_workers import LayingWorkers
from viaspline.fleet.ordered_crossings import ordered_crossings
from viaspline.fleet.precedences import precedences_of
from viaspline.fleet.relaid_fleet import relaid_fleet
from viaspline.fleet.timed_fleet import FleetWays, TimedFleet, on_lattice
from viaspline.handed_in import check_callable, check_kind, number_from
from viaspline.mission.fleet.fleet import Fleet

FleetProgress = Callable[[str, float], None]
"""Called with what is being done, and the share of it that is done."""


def plan_fleet(
    fleet: Fleet,
    improve: float = 0.0,
    progress: FleetProgress | None = None,
    paths: CrossingPaths | None = None,
    workers: LayingWorkers = THIS_PROCESS,
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
        workers: Who lays the paths, if they aren't: this process, ``Processes`` or a ``Cluster``
            (``viaspline.fleet.laying.laying_workers``). The plan doesn't depend on that.

    Returns:
        The plans of those that are served, proven apart, and why the others are not.

    Raises:
        GeometryError: ``improve`` is no finite number of 0 or more.
        WorkersError: The workers died.

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
    check_callable("workers.each", getattr(workers, "each", None), "give Processes(4)")

    def tell(stage: str, share: float) -> None:
        if progress is not None:
            progress(stage, share)

    if paths is None:
        paths = crossing_paths(
            fleet, lambda done, of: tell("laying paths", done / of), workers=workers
        )
    tell("timing", 0.0)
    timed = _served(fleet, FleetWays.of(fleet, paths))
    if improve > 0.0:
        timed = timed.improved(improve, lambda share: tell("improving", share))
    tell("proving", 0.0)
    return _planned(fleet, timed, paths.laid.not_served)


def plan_by_priority(fleet: Fleet, paths: CrossingPaths) -> FleetPlan:
    """Plan a fleet along its paths, by priority alone.

    Those that can't be timed so stand at their starts: ``plan_fleet`` looks for other ways then,
    which takes longer.

    Args:
        fleet: What is asked for.
        paths: Of the very fleet.
    """
    timed = TimedFleet.by_priority(FleetWays.of(fleet, paths))
    if timed.blocked:
        timed = timed.past_standing_ones()
    return _planned(fleet, timed, paths.laid.not_served)


def _served(fleet: Fleet, ways: FleetWays) -> TimedFleet:
    """Robots timed along their paths, with other paths where that leaves some without a law."""
    timed = TimedFleet.by_priority(ways)
    if not timed.blocked:
        return timed
    led = on_lattice(ways, fleet.separation_m)
    if isinstance(led, TimedFleet) and not led.blocked:
        return led
    timed = relaid_fleet(fleet, timed) or timed
    return timed.past_standing_ones() if timed.blocked else timed


def _planned(fleet: Fleet, timed: TimedFleet, not_served: Sequence[NotServed]) -> FleetPlan:
    """The plan of a fleet that is timed."""
    ways, timing = timed.ways, timed.timing
    courses, names = ways.courses, ways.courses.names
    unserved = [
        NotServed(
            names[robot], "gave up",
            f"it can't be timed along its path: '{names[other]}' is in its way",
            f"give '{names[other]}' another start, goal or priority, or let it leave",
        )
        for robot, other in sorted(timing.blocked.items())
    ]  # fmt: skip
    crossings = ordered_crossings(courses, ways.crossings, timing.laws)
    return FleetPlan(
        fleet=fleet,
        plans=timed.plans(),
        not_served=(*not_served, *unserved),
        certificate=certify_fleet(courses, timing.laws, fleet.separation_m),
        precedences=precedences_of(courses, crossings, timing.laws, ways.rides.laws),
        alone=dict(zip(names, ways.rides.alone.tolist(), strict=True)),
        courses=courses,
        crossings=crossings,
        laws=timing.laws,
        rides=ways.rides,
    )
