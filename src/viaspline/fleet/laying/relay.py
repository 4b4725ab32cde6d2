"""A robot's path and law laid anew at once, among robots that are timed already.

Where robots want each other's places, or meet head-on where two can't pass, no timing along fixed
paths serves all of them: one has to get out of the other's way. So those that are timed are things
that move as it is known to the next one, which finds a path and a law together: on another side,
later, or aside into a bay until the others are past.

The work of that grows with everything that moves. So at first only those are looked at that are
known to be in the way, and then, round by round, those that the law that was found comes too near
to.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace

import numpy as np

from viaspline.errors import Change, GaveUpError, GeometryError, NoPathError, PlanningError
from viaspline.fleet.laying.lay_round_stretch import laying_cost
from viaspline.fleet.laying.laying_work import Laid, LayingWork
from viaspline.fleet.laying.met_on_the_way import comes_too_near
from viaspline.fleet.laying.resting_places import RestingPlaces, rests_of
from viaspline.fleet.laying.robot_as_obstacle import as_obstacle
from viaspline.kernels.arrays import Floats
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.mission.model import Mission
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.plan_again import plan_again
from viaspline.planner import Plan, plan_in
from viaspline.planning.checking.conflicts import proven
from viaspline.planning.problem.requirements import Requirements
from viaspline.whole_plan import in_order
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.world import World

SETTLED_S = 1.0
"""For so long beyond the last arrival of others a robot holds its goal [s]."""
KEPT_MORE_M = 0.02
"""What a path keeps from other robots beyond what it must [m]."""
MAX_LOOKS = 6
"""How often a robot is laid, each time among those as well that it came too near to."""
MOST_NEAR = 12
"""Among so many that move a robot is laid, at most."""
RELAY_S = 20.0
"""What laying a robot may spend where it isn't said [s of the reference machine]."""
LEAST_OBSTACLE_M = 0.01
"""The radius of an obstacle that a robot's own clearance would make up for [m]."""


def relay(
    fleet: Fleet, member: FleetMember, fixed: Mapping[str, Plan], near: Collection[str] = (),
    before: Plan | None = None, work: LayingWork | None = None,
) -> Plan:  # fmt: skip
    """Lay and time one robot's path among robots that are timed.

    Those that are neither timed nor this one stand at their starts as long as that is possible:
    where there is no way round one of them, it is taken to have left.

    Args:
        fleet: What is asked for.
        member: The robot.
        fixed: Plans of those that are timed, by name: with laws by the clock of the fleet.
        near: Those of them that are known to be in its way.
        before: Another plan of the robot, if there is one.
        work: What may be spent, and what is known; None: ``RELAY_S``.

    Returns:
        A plan whose law begins when the robot may depart; it may wait at its start first.

    Raises:
        NoPathError: When there is none, whatever is tried.
        GaveUpError: When none was found.

    Example:
        >>> fleet = Fleet.model_validate({"separation_m": 1, "fleet": [
        ...     {"name": "a", "route": {"start": [0, 0], "goal": [30, 0]}},
        ...     {"name": "b", "route": {"start": [30, 0], "goal": [0, 0]}},
        ... ]})
        >>> a, b = fleet.members
        >>> first = relay(fleet, a, {})
        >>> second = relay(fleet, b, {"a": first})
        >>> second.path.length < 40.0, second.trajectory.end_time < 30.0
        (True, True)
    """
    work = LayingWork.of(RELAY_S) if work is None else work
    others = {name: plan for name, plan in fixed.items() if name != member.name}
    among = [name for name in others if name in near]
    for _ in range(MAX_LOOKS):
        moving = _moving(fleet, member, {name: others[name] for name in among})
        _refuse_overrun(member, moving)
        before = found = _laid(fleet, member, others, moving, before, work)
        met = [
            name
            for name, plan in others.items()
            if name not in among and comes_too_near(fleet, member, found, name, plan)
        ]
        if not met:
            return found
        among += met
        if len(among) > MOST_NEAR:
            break
    raise GaveUpError(
        f"too many robots come by: {', '.join(among[:5])} …",
        where=member.mission.route.start.at,
        remedy="let it depart later (depart_s), or send fewer robots through there",
        obstacles=among,
        tried=("moving robots",),
    )


def _spent(mission: Mission) -> GaveUpError:
    """The error that what could be spent on a robot is spent."""
    return GaveUpError(
        "what may be spent on its way was spent before it was known",
        where=mission.route.start.at,
        remedy="give it a priority above those of the others, or let it depart later (depart_s)",
        tried=("paths and waits among those that it came too near to, one look after the other",),
    )


def _laid(
    fleet: Fleet, member: FleetMember, fixed: Mapping[str, Plan], moving: tuple[Obstacle, ...],
    before: Plan | None, work: LayingWork,
) -> Plan:  # fmt: skip
    """A robot's path and law among some that move, and those that stand at their starts."""
    mission, world = in_order(member.mission)
    rests = _standing(fleet, member, fixed)
    among = _among(mission, member, moving, fixed)

    def planned(around: RestingPlaces) -> Plan:
        there = _with_discs(world, fleet, member, around) if around.places else world
        return _as_asked(_planned(among, there, around, before, work), mission, world)

    if rests.places:
        try:
            return planned(rests)
        except (PlanningError, GeometryError):
            pass  # somebody who stands in the way now may have left by then
    return planned(RestingPlaces(()))


def _planned(
    mission: Mission, world: World, rests: RestingPlaces, before: Plan | None, work: LayingWork
) -> Plan:
    """The plan of a mission among what moves, with rests in its world; or the one made before."""

    def lay() -> Laid:
        if work.is_spent:
            return _spent(mission)
        try:
            if before is None:
                return plan_in(mission, world, work.budget)
            work.budget.spent += laying_cost(before)
            return plan_again(before, mission, world, work.budget)
        except (PlanningError, GeometryError) as error:
            return error

    known = None if before is None else (before.mission.robot, before.tracking_error)
    found = work.once((mission, rests.places, known), lay)
    if isinstance(found, Plan):
        return found
    raise found.with_traceback(None)


def _needed(fleet: Fleet, member: FleetMember, reach: float) -> float:
    """The radius of an obstacle that keeps a robot as far off as one of another reach [m].

    A robot keeps its own clearance to obstacles; the rest is the obstacle's.
    """
    robot = member.mission.robot
    return max(reach + 0.5 * fleet.separation_m - robot.clearance_m + KEPT_MORE_M, LEAST_OBSTACLE_M)


def _moving(fleet: Fleet, member: FleetMember, fixed: Mapping[str, Plan]) -> tuple[Obstacle, ...]:
    """The robots that are timed, as obstacles to this one."""
    found = []
    for other in fleet.members:
        plan = fixed.get(other.name)
        if plan is None or other.name == member.name:
            continue
        body = plan.mission.robot.outer_radius + plan.tracking_error
        radius = _needed(fleet, member, body + 0.5 * fleet.separation_m)
        found.append(as_obstacle(other.name, plan, radius, other.rest))
    return tuple(found)


def _standing(fleet: Fleet, member: FleetMember, fixed: Mapping[str, Plan]) -> RestingPlaces:
    """The starts of robots that aren't timed, but for those where this one has to get to."""
    starts = []
    for other in fleet.members:
        if other.name not in fixed and other.name != member.name:
            robot = other.mission.robot
            reach = robot.outer_radius + (robot.tracking_error_m or 0.0) + 0.5 * fleet.separation_m
            starts.append(next(rests_of(other, reach)))
    rests = RestingPlaces(tuple(starts))
    robot = member.mission.robot
    own = robot.outer_radius + (robot.tracking_error_m or 0.0) + 0.5 * fleet.separation_m
    points = np.array([via.at[:2] for _, via in member.mission.route.points()])
    taken = rests.at(points, own + 2.0 * KEPT_MORE_M)
    return RestingPlaces(tuple(one for k, one in enumerate(rests.places) if k not in taken))


def _with_discs(world: World, fleet: Fleet, member: FleetMember, rests: RestingPlaces) -> World:
    """The world with robots standing in it."""
    rows: Floats = rests.rows.copy()
    rows[:, 2] = [_needed(fleet, member, one.reach) for one in rests.places]
    discs = tuple(
        Obstacle.model_construct(
            name=rest.robot, circle=Circle.model_construct(center=rest.at, radius=float(radius))
        )
        for rest, radius in zip(rests.places, rows[:, 2], strict=True)
    )
    return world.with_discs(discs, rows)


def _among(
    mission: Mission, member: FleetMember, moving: tuple[Obstacle, ...], fixed: Mapping[str, Plan]
) -> Mission:
    """The mission among robots that move; it holds its goal until they have arrived."""
    known = (*mission.world.known, *moving)
    route = mission.route
    if member.rest == "stay" and fixed:
        last = max(plan.trajectory.end_time for plan in fixed.values())
        hold = max(route.hold_s, last - route.depart_s + SETTLED_S, 0.0)
        route = route.model_copy(update={"hold_s": hold})
    return mission.model_copy(
        update={"world": mission.world.model_copy(update={"known": known}), "route": route}
    )


def _refuse_overrun(member: FleetMember, moving: tuple[Obstacle, ...]) -> None:
    """Refuse a robot that is run over before it may depart.

    Raises:
        NoPathError: With who comes too near, and when it would have to leave.
    """
    route, robot = member.mission.route, member.mission.robot
    until = route.depart_s
    if until <= 0.0 or not moving:
        return
    times = np.append(np.arange(0.0, until, 0.1), until)
    places = np.tile(np.array(route.start.at[:2], float), (len(times), 1))
    gaps, nearest = MovingObstacles(moving).nearest(places, times)
    near = np.flatnonzero(gaps < robot.outer_radius + robot.clearance_m)
    if near.size:
        name, time = moving[int(nearest[near[0]])].name, float(times[near[0]])
        raise NoPathError(
            f"'{name}' comes by its start at {time:.1f} s, before it may depart",
            where=route.start.at,
            remedy=f"let it depart by {time:.1f} s (depart_s), or '{name}' later",
            obstacles=(name or "",),
            changes=(Change("route.depart_s", round(time, 1)),),
        )


def _as_asked(plan: Plan, mission: Mission, world: World) -> Plan:
    """A plan among other robots as one of the mission as it was asked for."""
    robot = plan.mission.robot  # with what steering it has in reserve
    asked = mission.model_copy(update={"robot": robot})
    requirements = Requirements.of(asked, plan.tracking_error)
    law = plan.trajectory
    if plan.timed is None:
        law = law.delayed(mission.route.depart_s - law.start_time)
    return replace(
        plan,
        mission=asked,
        world=world,
        certificate=proven(plan.path, world, requirements),
        trajectory=law,
    )
