"""A fleet's plan: paths first, then who passes when, then the proof."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from viaspline.errors import GeometryError
from viaspline.fleet.crossing_paths import CrossingPaths, crossing_paths
from viaspline.fleet.fleet_certificate import certify_fleet
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.not_served import NotServed
from viaspline.fleet.ordered_crossings import ordered_crossings
from viaspline.fleet.precedences import precedences_of
from viaspline.fleet.rerouted_fleet import rerouted_fleet, try_cost
from viaspline.fleet.served_fleet import WHOLE_EFFORT, served_fleet
from viaspline.fleet.timed_fleet import FleetWays, TimedFleet
from viaspline.fleet.unserved.explain_unserved import explain_unserved
from viaspline.handed_in import check_callable, check_kind, number_from
from viaspline.mission.fleet.fleet import Fleet

FleetProgress = Callable[[str, float], None]
"""Called with what is being done, and the share of it that is done."""

TRIES_S = 20.0
"""What may be spent on what would help those that aren't served [s on the reference machine]."""
LEAST_TRIES = 8
"""Other paths are sought for those that wait where there is time for so many, at least."""
POLISH_SHARE = 0.02
"""Of the time for other paths, in which sooner orders are sought with each of them."""


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
    timed = served_fleet(fleet, paths, WHOLE_EFFORT)
    if improve > 0.0:
        timed = _improved(fleet, timed, paths, improve, lambda share: tell("improving", share))
    tell("proving", 0.0)
    unserved = explain_unserved(fleet, paths, timed, TRIES_S)
    return _planned(fleet, timed, (*paths.laid.not_served, *unserved))


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
    unserved = explain_unserved(fleet, paths, timed, 0.0)
    return _planned(fleet, timed, (*paths.laid.not_served, *unserved))


def _improved(
    fleet: Fleet, timed: TimedFleet, paths: CrossingPaths, seconds: float,
    progress: Callable[[float], None],
) -> TimedFleet:  # fmt: skip
    """Sooner orders, and if there is time for enough of them other paths for those that wait.

    Args:
        fleet: What is asked for.
        timed: Where it begins.
        paths: Of the fleet.
        seconds: What may be spent [s on the reference machine].
        progress: Called with the share that is spent.
    """
    third, kept = seconds / 3.0, paths.laid.kept
    costs = [try_cost(timed, robot) for robot in range(len(timed.ways.members))]
    if kept is None or timed.blocked or not costs or LEAST_TRIES * max(costs) > third:
        return timed.improved(seconds, progress)
    timed = timed.improved(third, lambda share: progress(share / 3.0))
    timed = rerouted_fleet(
        timed, kept, fleet.separation_m, third, polish=POLISH_SHARE * third,
        progress=lambda share: progress((1.0 + share) / 3.0),
    )  # fmt: skip
    return timed.improved(third, lambda share: progress((2.0 + share) / 3.0))


def _planned(fleet: Fleet, timed: TimedFleet, not_served: Sequence[NotServed]) -> FleetPlan:
    """The plan of a fleet that is timed."""
    ways, timing = timed.ways, timed.timing
    courses, names = ways.courses, ways.courses.names
    crossings = ordered_crossings(courses, ways.crossings, timing.laws)
    return FleetPlan(
        fleet=fleet,
        plans=timed.plans(),
        not_served=tuple(not_served),
        certificate=certify_fleet(courses, timing.laws, fleet.separation_m),
        precedences=precedences_of(courses, crossings, timing.laws, ways.rides.laws),
        alone=dict(zip(names, ways.rides.alone.tolist(), strict=True)),
        courses=courses,
        crossings=crossings,
        laws=timing.laws,
        rides=ways.rides,
    )
