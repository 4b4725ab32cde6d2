"""A fleet's plan in space: paths first, then who passes when, then the proof.

What planar fleets are led over beside that, lattices, paths laid in space and time at once, and
patrols that never end, there isn't in space; where timing leaves a robot without a law it is led
round the path of the one that is in its way, and else it is said that the planner gave up.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import permutations
from typing import Final

from viaspline.errors import GeometryError
from viaspline.fleet.fleet_certificate import certify_fleet
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.laying.laying_workers import LayingWorkers
from viaspline.fleet.not_served import NotServed
from viaspline.fleet.ordered_crossings import ordered_crossings
from viaspline.fleet.precedences import precedences_of
from viaspline.fleet.space.flown_ways import FlownWays
from viaspline.fleet.space.lay_in_space import lay_in_space
from viaspline.fleet.space.lay_round_path import led_apart
from viaspline.fleet.timing.time_paths import Timing
from viaspline.mission.fleet.fleet import Fleet

MAX_LED: Final = 12
"""How many other paths are tried for robots that can't be timed."""


def plan_spatial_fleet(
    fleet: Fleet, improve: float, tell: Callable[[str, float], None], workers: LayingWorkers
) -> FleetPlan:
    """Plan a fleet in space.

    Each path is laid by itself, round the places where others rest. Then robots are timed along
    their paths by priority and by the orders that are forced: who comes second to a crossing flies
    slower before it, or hovers. Bodies are balls or upright cylinders, as they are: two may pass
    one above the other.

    Args:
        fleet: What is asked for.
        improve: For so long sooner orders are sought [s, on the reference machine].
        tell: Hears what is being done, and the share of it that is done.
        workers: Who lays the paths.

    Raises:
        GeometryError: Something moves in its world, or a robot is on a patrol that never ends.
        GaveUpError: Paths come near each other in too many places.
        WorkersError: The workers died.

    Example:
        >>> from viaspline.fleet.laying.lay_paths import THIS_PROCESS
        >>> fleet = Fleet.model_validate({
        ...     "separation_m": 2, "robots": {"drone": {"radius_m": 0.4, "half_height_m": 0.2}},
        ...     "fleet": [
        ...         {"name": "a", "route": {"start": [0, 0, 10], "goal": [40, 0, 10]}},
        ...         {"name": "b", "route": {"start": [20, -20, 11], "goal": [20, 20, 11]}},
        ...     ],
        ... })
        >>> plan = plan_spatial_fleet(fleet, 0.0, lambda words, share: None, THIS_PROCESS)
        >>> plan.served, plan.certificate.separation >= 2.0
        (True, True)
        >>> [(one.first, one.second) for one in plan.precedences]
        [('a', 'b')]
    """
    _refuse_what_is_not_planned(fleet)
    laid = lay_in_space(
        fleet.members, fleet.separation_m, workers, lambda share: tell("laying paths", share)
    )
    tell("timing", 0.0)
    members = [one for one in fleet.members if one.name in laid.plans]
    plans = [laid.plans[one.name] for one in members]
    ways = FlownWays.of(members, plans, fleet.separation_m)
    ways, timing = _timed(ways, fleet.separation_m)
    if improve > 0.0:
        timing = ways.improved(timing, improve, lambda share: tell("improving", share))
    tell("proving", 0.0)
    return _planned(fleet, ways, timing, (*laid.not_served, *_unserved(ways, timing)))


def _refuse_what_is_not_planned(fleet: Fleet) -> None:
    """Say what of a fleet isn't planned in space, rather than leave it out."""
    if fleet.world.moving:
        raise GeometryError(
            "a fleet in space isn't planned among things that move; leave out their motion"
        )
    for one in fleet.members:
        if one.mission.route.is_patrol:
            raise GeometryError(
                f"'{one.name}' is a patrol that never ends, and fleets in space fly none; give its "
                "route laps"
            )


def _timed(ways: FlownWays, separation: float) -> tuple[FlownWays, Timing]:
    """Robots timed; those that can't be, led round who is in their way, as far as that helps."""
    timing = ways.timed()
    tried: set[tuple[int, int]] = set()
    while timing.blocked and len(tried) < MAX_LED:
        pairs = [
            order
            for pair in timing.blocked.items()
            for order in permutations(pair)
            if order not in tried
        ]
        if not pairs:
            break
        robot, other = pairs[0]
        tried.add((robot, other))
        led = led_apart(ways, robot, other, separation)
        again = None if led is None else led.timed()
        if led is not None and again is not None and len(again.blocked) < len(timing.blocked):
            ways, timing = led, again
    return ways, ways.past_standing_ones(timing) if timing.blocked else timing


def _unserved(ways: FlownWays, timing: Timing) -> list[NotServed]:
    """What is told of robots that have a path and no law."""
    names = ways.courses.names
    return [
        NotServed(
            names[robot],
            "gave up",
            f"it can't be timed along its path: '{names[other]}' is in its way, and no path round "
            "that one's was found that helps",
            f"give '{names[other]}' another start, goal, height or priority, or let it leave",
            (names[other],),
            ways.members[robot].mission.route.start.at,
        )
        for robot, other in sorted(timing.blocked.items())
    ]


def _planned(
    fleet: Fleet, ways: FlownWays, timing: Timing, not_served: tuple[NotServed, ...]
) -> FleetPlan:
    """The plan of a fleet that is timed."""
    courses, names = ways.courses, ways.courses.names
    crossings = ordered_crossings(courses, ways.crossings, timing.laws)
    return FleetPlan(
        fleet=fleet,
        plans=ways.flown(timing),
        not_served=not_served,
        certificate=certify_fleet(courses, timing.laws, fleet.separation_m),
        precedences=precedences_of(courses, crossings, timing.laws, ways.rides.laws),
        alone=dict(zip(names, ways.rides.alone.tolist(), strict=True)),
        courses=courses,
        crossings=crossings,
        laws=timing.laws,
        rides=ways.rides,
    )
