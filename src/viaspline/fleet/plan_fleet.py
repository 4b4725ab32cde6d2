"""A fleet's plan: paths first, then who passes when, then the proof."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

from viaspline.errors import GeometryError
from viaspline.fleet.among_moving import among_moving, proven_among
from viaspline.fleet.crossing_paths import CrossingPaths, crossing_paths
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.late_share import arrivals_of
from viaspline.fleet.laying.alone_paths import AlonePaths, alone_paths
from viaspline.fleet.laying.laid_pieces import THIS_PROCESS, LayingProgress
from viaspline.fleet.laying.laying_work import LayingWork
from viaspline.fleet.laying.laying_workers import LayingWorkers
from viaspline.fleet.led_fleet import is_dense, led_at_once, may_be_led_sooner
from viaspline.fleet.not_served import NotServed
from viaspline.fleet.ordered_crossings import ordered_crossings
from viaspline.fleet.patrols.timed_patrols import timed_patrols
from viaspline.fleet.precedences import precedences_of
from viaspline.fleet.relaid_fleet import relaid_fleet
from viaspline.fleet.rerouted_fleet import rerouted_fleet, try_cost
from viaspline.fleet.robots_at_home import certify_all
from viaspline.fleet.served_fleet import RELAY_S, REROUTE_S, served_along
from viaspline.fleet.space.plan_spatial_fleet import plan_spatial_fleet
from viaspline.fleet.still_world import without_motion
from viaspline.fleet.straight_fleet import WaysRound
from viaspline.fleet.swerved_fleet import swerved_fleet
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.fleet.timing.rides import goal_stays
from viaspline.fleet.timing.time_paths import MANY
from viaspline.fleet.told_progress import FleetProgress, untold
from viaspline.fleet.unserved.explain_unserved import explain_unserved
from viaspline.fleet.unserved.unserved_beside import unserved_beside
from viaspline.formats.asked_for import AskedFleet, asked_fleet
from viaspline.handed_in import check_callable, number_from
from viaspline.mission.fleet.fleet import Fleet

PERIODS = 2
"""Of patrols that never end so many periods are planned, from when nobody else moves any more."""
TRIES_S = 20.0
"""What may be spent on what would help those that aren't served [s on the reference machine]."""
LEAST_TRIES = 8
"""Other paths are sought for those that wait where there is time for so many, at least."""
SWERVING_SHARE = 0.9
"""Of the time for sooner orders, of many robots, in which their paths are led aside at first: so
much at most."""
POLISH_SHARE = 0.02
"""Of the time for other paths, in which sooner orders are sought with each of them."""


def plan_fleet(
    fleet: AskedFleet,
    improve: float = 0.0,
    progress: FleetProgress | None = None,
    paths: CrossingPaths | None = None,
    workers: LayingWorkers = THIS_PROCESS,
    *,
    periods: int = PERIODS,
) -> FleetPlan:
    """Plan a fleet: a path for each robot, when it drives along it, and the proof of both.

    Each path is laid by itself, round the places where others rest. Then robots are timed along
    their paths by priority and by the orders that are forced: who comes second to a crossing is
    slowed down for it. No path passes another's resting place? Then all are served.

    Args:
        fleet: What is asked for, or the file that it stands in.
        improve: For so long sooner orders are sought [s, on the reference machine].
        progress: See ``FleetProgress``.
        paths: Of the very fleet, if they are laid already.
        workers: Who lays the paths, if they aren't: this process, ``Processes`` or a ``Cluster``
            (``viaspline.fleet.laying.laying_workers``). The plan doesn't depend on that.
        periods: Plans of patrols, which never end, hold so many periods at least from when nobody
            else moves any more.

    Returns:
        The plans of those that are served, proven apart, and why the others are not. Those of a
        fleet that says heights are plans in space, see
        `viaspline.fleet.space.plan_spatial_fleet`.

    Raises:
        GeometryError: ``improve`` is no finite number of 0 or more, or ``periods`` no whole number
            of 1 or more.
        GaveUpError: There are too many crossings, or too many laps until all others have arrived.
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
    fleet = asked_fleet(fleet)
    improve = number_from("improve", improve)
    if not 0.0 <= improve < math.inf:
        raise GeometryError(f"improve is {improve}; give a finite number of seconds, 0 or more")
    if isinstance(periods, bool) or not isinstance(periods, int) or periods < 1:
        raise GeometryError(f"periods is {periods!r}; give a whole number of 1 or more")
    if progress is not None:
        check_callable("progress", progress, "give a function of words and a share")
    check_callable("workers.each", getattr(workers, "each", None), "give Processes(4)")

    def tell(stage: str, share: float) -> None:
        if progress is not None:
            progress(stage, share)

    if fleet.is_spatial:
        return plan_spatial_fleet(fleet, improve, tell, workers, periods)

    def improving(share: float) -> None:
        tell("improving", share)

    def laying(done: int, of: int) -> None:
        tell("laying paths", done / of)

    alone = _alone(fleet, paths, laying, workers)
    if alone is not None and is_dense(fleet, alone):
        tell("searching for an order", 0.0)
        led = led_at_once(fleet, alone)
        if led is not None:
            led = _sooner(led, improve, improving)
            tell("proving", 0.0)
            return _planned(fleet, led, ())
    if paths is None:
        paths = crossing_paths(fleet, laying, workers=workers, alone=alone)
    tell("timing", 0.0)
    timed = _timed(fleet, paths, improve, periods, tell)
    unserved = _unserved(fleet, paths, timed, TRIES_S, tell)
    tell("proving", 0.0)
    return _planned(fleet, timed, (*paths.laid.not_served, *unserved))


def _alone(
    fleet: Fleet, paths: CrossingPaths | None, progress: LayingProgress, workers: LayingWorkers
) -> AlonePaths | None:
    """What each robot does if it is alone; None where that isn't known of the paths."""
    if paths is None:
        return alone_paths(without_motion(fleet), progress, workers=workers)
    return None if paths.laid.kept is None else AlonePaths.of_kept(paths.laid.kept)


def _timed(
    fleet: Fleet, paths: CrossingPaths, improve: float, periods: int, tell: FleetProgress
) -> TimedFleet:
    """The robots of a fleet timed along its paths, or along others."""

    def improving(share: float) -> None:
        tell("improving", share)

    still, work = without_motion(fleet), LayingWork.of(RELAY_S)
    ways = FleetWays.of(still, paths)
    if still is not fleet:

        def serve(out: dict[int, int]) -> TimedFleet:
            return _sooner(_of_those_that_end(still, ways, out, work, tell), improve, improving)

        return among_moving(fleet, ways, serve, work, tell)
    if _has_patrols(ways):
        timed = timed_patrols(
            ways, fleet.separation_m, periods,
            lambda among, out: _of_those_that_end(fleet, among, out, work, tell),
        )  # fmt: skip
        return _sooner(timed, improve, improving)
    timed = served_along(fleet, paths, REROUTE_S, work, tell)
    return _improved(fleet, timed, paths, improve, improving) if improve > 0.0 else timed


def plan_by_priority(fleet: Fleet, paths: CrossingPaths) -> FleetPlan:
    """Plan a fleet along its paths, by priority alone.

    Those that can't be timed so stand at their starts: ``plan_fleet`` looks for other ways then,
    which takes longer.

    Args:
        fleet: What is asked for.
        paths: Of the very fleet.
    """
    still = without_motion(fleet)
    ways = FleetWays.of(still, paths)
    if still is not fleet:
        work = LayingWork.of(RELAY_S)
        timed = among_moving(fleet, ways, lambda out: _by_priority(ways, out), work)
    elif _has_patrols(ways):
        timed = timed_patrols(ways, fleet.separation_m, PERIODS, _by_priority)
    else:
        timed = _by_priority(ways, {})
    return _planned(fleet, timed, (*paths.laid.not_served, *_unserved(fleet, paths, timed, 0.0)))


def is_settled_by_priority(plan: FleetPlan, paths: CrossingPaths) -> bool:
    """Whether ``plan_fleet`` has nothing better for a fleet than ``plan_by_priority``.

    Args:
        plan: By priority.
        paths: Of the very fleet.
    """
    if len(plan.plans) < len(paths.laid.plans):
        return False
    if plan.patrols is not None or plan.fleet.world.moving:
        return True
    if WaysRound.of(paths.laid.plans, paths.laid.kept).long:
        return False
    arrivals = arrivals_of(plan.courses, plan.laws) + goal_stays(plan.courses, plan.rides)
    if may_be_led_sooner(plan.rides, arrivals):
        return False
    kept = paths.laid.kept
    return kept is None or not is_dense(plan.fleet, AlonePaths.of_kept(kept))


def _unserved(
    fleet: Fleet, paths: CrossingPaths, timed: TimedFleet, budget: float,
    tell: FleetProgress = untold,
) -> Sequence[NotServed]:  # fmt: skip
    """Why robots couldn't be timed, and what would help."""
    if not fleet.world.moving and not _has_patrols(timed.ways):
        return explain_unserved(fleet, paths, timed, budget, tell)
    return unserved_beside(timed)


def _by_priority(ways: FleetWays, left_out: dict[int, int]) -> TimedFleet:
    """Robots timed by priority, past those that can't be, which stand at their starts."""
    timed = TimedFleet.by_priority(ways, left_out)
    return timed.past_standing_ones(left_out) if timed.blocked else timed


def _has_patrols(ways: FleetWays) -> bool:
    return any(one.mission.route.is_patrol for one in ways.members)


def _of_those_that_end(
    fleet: Fleet, ways: FleetWays, left_out: dict[int, int], work: LayingWork, tell: FleetProgress
) -> TimedFleet:
    """Robots timed where patrols have their laws already, or something moves.

    Args:
        fleet: What is asked for.
        ways: Of its robots.
        left_out: Robots that stand at their starts, each with one that is in its way.
        work: What may be spent on laying robots anew.
        tell: Told of that.
    """
    timed = TimedFleet.by_priority(ways, left_out)
    if not timed.blocked:
        return timed
    if left_out:
        return timed.past_standing_ones(left_out)
    timed = relaid_fleet(fleet, timed, work, tell) or timed
    return timed.past_standing_ones() if timed.blocked else timed


def _sooner(timed: TimedFleet, seconds: float, progress: Callable[[float], None]) -> TimedFleet:
    """Sooner orders along the same paths, if there is time for them."""
    return timed.improved(seconds, progress) if seconds > 0.0 else timed


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
    kept = paths.laid.kept
    if kept is not None and not timed.blocked and len(timed.ways.members) >= MANY:
        swerving = SWERVING_SHARE * seconds
        timed, left = swerved_fleet(timed, kept.rests, fleet.separation_m, swerving)
        seconds += left - swerving
    third = seconds / 3.0
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
    patrols = timed.patrols
    certificate = certify_all(fleet, courses, timing.laws)
    if patrols is not None:
        certificate = replace(certificate, repeats=(patrols.repeats_from, patrols.period))
    crossings = ordered_crossings(courses, ways.crossings, timing.laws)
    plans = timed.planar_plans()
    if fleet.world.moving:
        plans = {name: proven_among(fleet, plan) for name, plan in plans.items()}
    return FleetPlan(
        fleet=fleet,
        plans=plans,
        not_served=tuple(not_served),
        certificate=certificate,
        precedences=precedences_of(courses, crossings, timing.laws, ways.rides.laws),
        alone=dict(zip(names, ways.rides.alone.tolist(), strict=True)),
        courses=courses,
        crossings=crossings,
        laws=timing.laws,
        rides=ways.rides,
        patrols=patrols,
    )
