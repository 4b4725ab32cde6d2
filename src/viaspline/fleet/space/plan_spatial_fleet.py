"""A fleet's plan in space: paths first, then who passes when, then the proof.

What planar fleets are led over beside that, lattices and paths laid in space and time at once,
there isn't in space; where timing leaves a robot without a law it is led round the path of the one
that is in its way, and else it is said that the planner gave up.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import permutations
from typing import Final

from viaspline.fleet.courses import AnyPlan
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.laying.laying_workers import LayingWorkers
from viaspline.fleet.not_served import NotServed
from viaspline.fleet.ordered_crossings import ordered_crossings
from viaspline.fleet.patrols.timed_patrols import timed_patrols
from viaspline.fleet.precedences import precedences_of
from viaspline.fleet.robots_at_home import certify_all
from viaspline.fleet.space.lay_in_space import lay_in_space
from viaspline.fleet.space.lay_round_path import led_apart
from viaspline.fleet.space.timed_past_moving import (
    past_moving,
    sooner_past_moving,
    timed_past_moving,
)
from viaspline.fleet.space.ways_past_moving import WaysPastMoving
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.fleet.told_progress import FleetProgress
from viaspline.mission.fleet.fleet import Fleet
from viaspline.space.spatial_plan import SpatialPlan

MAX_LED: Final = 12
"""How many other paths are tried for robots that can't be timed."""


def plan_spatial_fleet(
    fleet: Fleet, improve: float, tell: FleetProgress, workers: LayingWorkers,
    periods: int,
) -> FleetPlan:  # fmt: skip
    """Plan a fleet in space.

    Each path is laid by itself, round the places where others rest. Then robots are timed along
    their paths by priority and by the orders that are forced: who comes second to a crossing flies
    slower before it, or hovers. Bodies are balls or upright cylinders, as they are: two may pass
    one above the other. What moves is let pass by all; patrols, which never end, are timed before
    the others, in a period that is common to them.

    Args:
        fleet: What is asked for.
        improve: For so long sooner orders are sought [s, on the reference machine].
        tell: Hears what is being done, and the share of it that is done.
        workers: Who lays the paths.
        periods: Plans of patrols hold so many periods from when nobody else moves any more.

    Raises:
        GaveUpError: Paths come near each other in too many places.
        WorkersError: The workers died.

    Example:
        >>> from viaspline.fleet.laying.laid_pieces import THIS_PROCESS
        >>> fleet = Fleet.model_validate({
        ...     "separation_m": 2, "robots": {"drone": {"radius_m": 0.4, "half_height_m": 0.2}},
        ...     "fleet": [
        ...         {"name": "a", "route": {"start": [0, 0, 10], "goal": [40, 0, 10]}},
        ...         {"name": "b", "route": {"start": [20, -20, 11], "goal": [20, 20, 11]}},
        ...     ],
        ... })
        >>> plan = plan_spatial_fleet(fleet, 0.0, lambda words, share: None, THIS_PROCESS, 2)
        >>> plan.served, plan.certificate.separation >= 2.0
        (True, True)
        >>> [(one.first, one.second) for one in plan.precedences]
        [('a', 'b')]
    """
    laid = lay_in_space(
        fleet.members, fleet.separation_m, workers, lambda share: tell("laying paths", share)
    )
    tell("timing", 0.0)
    members = [one for one in fleet.members if one.name in laid.plans]
    plans: dict[str, AnyPlan] = {one.name: laid.plans[one.name] for one in members}
    timed = _timed(FleetWays.laid(members, plans, fleet.separation_m), fleet, periods, tell)
    if improve > 0.0:
        sooner = (
            sooner_past_moving if isinstance(timed.ways, WaysPastMoving) else TimedFleet.improved
        )
        timed = sooner(timed, improve, lambda share: tell("improving", share))
    tell("proving", 0.0)
    return _planned(fleet, timed, (*laid.not_served, *_unserved(timed)))


def _timed(ways: FleetWays, fleet: Fleet, periods: int, tell: FleetProgress) -> TimedFleet:
    """Robots timed along their ways, past what moves, and past patrols that never end."""

    def serve(among: FleetWays, left_out: dict[int, int]) -> TimedFleet:
        return _served(among, left_out, fleet.separation_m, tell)

    if ways.members and fleet.world.moving:
        return timed_past_moving(ways, serve)
    if any(one.mission.route.is_patrol for one in ways.members):
        return timed_patrols(ways, fleet.separation_m, periods, serve)
    return serve(ways, {})


def _served(
    ways: FleetWays, left_out: dict[int, int], separation: float, tell: FleetProgress
) -> TimedFleet:
    """Robots timed; those that can't be, led round who is in their way, as far as that helps.

    Args:
        ways: Theirs.
        left_out: Those that stand at their starts, each with what is in its way.
        separation: Free space between any two bodies [m].
        tell: Told each time that one is led round another.
    """
    timed = TimedFleet.by_priority(ways, left_out)
    tried: set[tuple[int, int]] = set()
    while set(timed.timing.blocked) - set(left_out) and len(tried) < MAX_LED:
        pairs = [
            order
            for pair in timed.timing.blocked.items()
            for order in permutations(pair)
            if order not in tried and pair[0] not in left_out and _may_be_led(ways, order[0])
        ]
        if not pairs:
            break
        robot, other = pairs[0]
        tell("looking for other paths", len(tried) / MAX_LED)
        tried.add((robot, other))
        led = led_apart(timed.ways, robot, other, separation)
        again = None if led is None else TimedFleet.by_priority(led, left_out)
        if again is not None and len(again.blocked) < len(timed.blocked):
            timed = again
    return timed.past_standing_ones(left_out) if timed.blocked else timed


def _may_be_led(ways: FleetWays, number: int) -> bool:
    """Whether somebody is a robot that has no law that is settled."""
    return number < len(ways.members) and ways.members[number].name not in ways.settled


def _unserved(timed: TimedFleet) -> list[NotServed]:
    """What is told of robots that have a path and no law."""
    ways = timed.ways
    found = []
    for robot, other in sorted(timed.timing.blocked.items()):
        reason, remedy = timed.reasons.get(robot) or _reason(ways, other)
        in_the_way = () if other == robot else (ways.name_of(other),)
        start = ways.members[robot].mission.route.start.at
        name = ways.courses.names[robot]
        found.append(NotServed(name, "gave up", reason, remedy, in_the_way, start))
    return found


def _reason(ways: FleetWays, other: int) -> tuple[str, str]:
    """Why a robot has no law, and what would help, by who or what is in its way."""
    name = ways.name_of(other)
    found = f"it can't be timed along its path: '{name}' is in its way, and no path round "
    if other >= len(ways.members):
        return (
            f"{found}the way of that was found that helps",
            "let it depart at another time (depart_s), or give it a via point beside that way",
        )
    return (
        f"{found}that one's was found that helps",
        f"give '{name}' another start, goal, height or priority, or let it leave",
    )


def _planned(fleet: Fleet, timed: TimedFleet, not_served: Sequence[NotServed]) -> FleetPlan:
    """The plan of a fleet that is timed."""
    ways, timing, patrols = timed.ways, timed.timing, timed.patrols
    courses, names = ways.courses, ways.courses.names
    crossings = ordered_crossings(courses, ways.crossings, timing.laws)
    certificate = certify_all(fleet, courses, timing.laws)
    if patrols is not None:
        certificate = replace(certificate, repeats=(patrols.repeats_from, patrols.period))
    return FleetPlan(
        fleet=fleet,
        plans=_plans(timed),
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


def _plans(timed: TimedFleet) -> dict[str, AnyPlan]:
    """The plans of a fleet, with what is proven of them and of what moves."""
    plans, ways = timed.plans(), timed.ways
    if not isinstance(ways, WaysPastMoving):
        return plans
    members = {one.name: one for one in ways.members}
    return {
        name: past_moving(members[name], plan) if isinstance(plan, SpatialPlan) else plan
        for name, plan in plans.items()
    }
