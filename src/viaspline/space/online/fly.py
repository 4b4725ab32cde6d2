"""A mission in space flown through the world as it is, with what isn't on its map.

The robot follows its path exactly. As soon as its sensor sees something in the way it looks for
another path from a place a little ahead, where that joins without a corner; if there is none that
it can fly into at its speed, it stops and looks from there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

import numpy as np

from viaspline.curve.certificate import certify
from viaspline.errors import GeometryError
from viaspline.formats.asked_for import AskedMission, asked_mission
from viaspline.handed_in import check_kind, time_from
from viaspline.mission.model import Mission
from viaspline.mission.space.flight_places import flight_places
from viaspline.space.online.flown_leg import FlownLeg
from viaspline.space.online.recorded_flight import recorded
from viaspline.space.online.replan_in_space import NewLeg, replan_in_space
from viaspline.space.online.sightings import UnseenSolid, first_sighting
from viaspline.space.online.takeover import Takeover, braked_takeover, smooth_takeover
from viaspline.space.plan_spatial import plan_spatial
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_problem import SpatialProblem, SpatialVia
from viaspline.space.spatial_request import spatial_problem_of, spatial_world_of
from viaspline.space.spatial_run import SpatialReplan, SpatialRun
from viaspline.trajectory.retime import braking
from viaspline.world.space.spatial_world import SpatialWorld

STEP_S: Final = 0.1
"""Between two looks of the sensor."""

MAX_REPLANS: Final = 200

SPEED_SHARES: Final = (0.6, 0.3, 0.0)
"""Of the speed, down to which the robot brakes where a path can't be flown into any faster."""


@dataclass(frozen=True, eq=False)
class _Flight:
    """A flight so far.

    Attributes:
        legs: What was flown, and at last what is.
        problem: What the last leg solves, in the world as it is known.
        known: The mission with all that was seen on its map.
        unseen: What nobody has seen yet.
        replans: Where the path was changed.
        reason: Why it ended before the goal.
    """

    legs: tuple[FlownLeg, ...]
    problem: SpatialProblem
    known: Mission
    unseen: tuple[UnseenSolid, ...]
    replans: tuple[SpatialReplan, ...] = ()
    reason: str = ""


def fly(plan: SpatialPlan | AskedMission, step: float = STEP_S) -> SpatialRun:
    """Fly a plan.

    Args:
        plan: It; or a mission in space, or the file of one, which is planned first.
        step: From one moment of the result to the next, and between two looks [s].

    Raises:
        MissionError: When a file can't be read, or has faults.
        NoPathError, GaveUpError: When a mission has no path, or none is found.
        GeometryError: When there is something unseen and no sensor to see it, or the mission isn't
            one in space.

    Example:
        >>> import viaspline as vs
        >>> hop = {"start": [0, 0, 5], "goal": [20, 0, 8]}
        >>> above = {"ground": {"flat_m": 0}}
        >>> run = vs.fly(vs.Mission.model_validate({"world": above, "route": hop}))
        >>> run.reached, run.positions[-1].round(2).tolist()
        (True, [20.0, 0.0, 8.0])
    """
    plan = _planned(plan)
    step = time_from("step", step)
    mission = plan.mission
    flight = _Flight(
        (FlownLeg(plan.path, plan.trajectory, plan.yaw, np.inf),),
        _unrolled(spatial_problem_of(mission)), mission, _unseen(mission, plan.world),
    )  # fmt: skip
    if flight.unseen and mission.robot.sensor is None:
        raise GeometryError("there are unseen obstacles and no sensor; give robot.sensor.range_m")
    reach = 0.0 if mission.robot.sensor is None else mission.robot.sensor.reach
    now = plan.trajectory.start_time
    for _ in range(MAX_REPLANS):
        now, seen = first_sighting(flight.legs[-1], flight.unseen, reach, now, step)
        if not seen:
            break
        flight = _reacted(flight, now, seen)
        if flight.reason:
            break
    everything = _with_seen(mission, _unseen(mission, plan.world))
    world = spatial_world_of(everything, flight_places(mission))
    return recorded(plan, flight.legs, flight.replans, flight.reason, world, step)


def _planned(plan: object) -> SpatialPlan:
    """A plan that was handed in, or that of a mission that was."""
    if isinstance(plan, str | Path | Mission):
        mission = asked_mission(plan)
        if not mission.is_spatial:
            raise GeometryError("the mission says nothing of heights; hand it to simulate")
        return plan_spatial(mission)
    check_kind("plan", plan, SpatialPlan, "give plan(mission) of a mission in space")
    assert isinstance(plan, SpatialPlan)
    return plan


def _unrolled(problem: SpatialProblem) -> SpatialProblem:
    """A round of several laps with the via points of all of them."""
    if problem.laps == 1:
        return problem
    lap = tuple(problem.vias[1:])
    tension = np.tile(problem.shape.tension, problem.laps)
    return replace(
        problem, vias=(problem.vias[0], *(lap * problem.laps)), laps=1,
        shape=replace(problem.shape, tension=tension),
    )  # fmt: skip


def _unseen(mission: Mission, world: SpatialWorld) -> tuple[UnseenSolid, ...]:
    radius, half = world.packed.core.tolist()
    return tuple(
        UnseenSolid(
            one.name or f"world.unseen[{k}]", one.solid(),
            SpatialWorld.of([one.solid()], core_radius=radius, core_half_height=half),
        )
        for k, one in enumerate(mission.world.unseen_standing)
    )  # fmt: skip


def _reacted(flight: _Flight, now: float, seen: Sequence[UnseenSolid]) -> _Flight:
    """A flight in which something was seen: with another path, if it is in the way."""
    known = _with_seen(flight.known, seen)
    problem = replace(flight.problem, world=spatial_world_of(known, flight_places(known)))
    unseen = tuple(one for one in flight.unseen if one not in seen)
    flight = replace(flight, known=known, unseen=unseen, problem=problem)
    if all(_is_passed_clear(flight, now, one) for one in seen):
        return flight
    brake = problem.limits.along.brake
    names = tuple(one.name for one in seen)
    leg = flight.legs[-1]
    braked = (braked_takeover(leg, now, brake, share) for share in SPEED_SHARES)
    for begins in (smooth_takeover(leg, now, brake), *braked):
        ahead = _still_ahead(flight, begins)
        if not ahead:
            continue
        found = replan_in_space(known, problem, leg, ahead, begins)
        if isinstance(found, NewLeg):
            return _taken_over(flight, now, begins, found, names)
    return _stopped(flight, now, names)


def _with_seen(known: Mission, seen: Sequence[UnseenSolid]) -> Mission:
    """The mission with what was seen on its map."""
    names = {one.name for one in seen}
    world = known.world
    found = [
        one.model_copy(update={"name": one.name or f"world.unseen[{k}]"})
        for k, one in enumerate(world.unseen_standing)
        if (one.name or f"world.unseen[{k}]") in names
    ]
    return known.model_copy(
        update={"world": world.model_copy(update={"known": (*world.known, *found)})}
    )


def _is_passed_clear(flight: _Flight, now: float, one: UnseenSolid) -> bool:
    """Whether the rest of the path is clear of something."""
    leg, problem = flight.legs[-1], flight.problem
    distance = min(float(leg.law.distance_at(now)), leg.path.length)
    u = float(np.asarray(leg.path.parameter(distance)))
    end = leg.path.domain[1]
    if u >= end:
        return True
    rest = leg.path.section(u, end)
    return certify(rest, one.world, problem.clearance, radius=problem.radius).holds


def _still_ahead(flight: _Flight, begins: Takeover) -> tuple[SpatialVia, ...]:
    """The via points after a take-over."""
    leg, problem = flight.legs[-1], flight.problem
    users = [via for via in leg.path.vias if via.kind == "user"]
    users = users[problem.takeoff is not None : len(users) - (problem.landing is not None)]
    distances = np.asarray(leg.path.distance([via.u for via in users]))
    later = distances > begins.distance + 1e-6
    return tuple(via for via, after in zip(problem.vias, later, strict=True) if after)


def _taken_over(
    flight: _Flight, now: float, begins: Takeover, found: NewLeg, names: tuple[str, ...]
) -> _Flight:
    old = _ended(flight.legs[-1], begins, flight.problem.limits.along.brake)
    replan = SpatialReplan(now, begins.time, names, found.leg.path, begins.speed == 0.0)
    return replace(
        flight, legs=(*flight.legs[:-1], old, found.leg), problem=found.problem,
        replans=(*flight.replans, replan),
    )  # fmt: skip


def _ended(leg: FlownLeg, begins: Takeover, brake: float) -> FlownLeg:
    """A leg as it is flown until another one begins."""
    if begins.since >= begins.time or begins.time >= leg.law.end_time:
        return replace(leg, until=begins.time)
    distance, speed, _ = (float(value) for value in leg.law.state_at(begins.since))
    stop = braking(distance, speed, brake, begins.since)
    return replace(leg, law=leg.law.followed_by(stop, begins.since), until=begins.time)


def _stopped(flight: _Flight, now: float, names: tuple[str, ...]) -> _Flight:
    """A flight that ends where the robot comes to rest."""
    brake = flight.problem.limits.along.brake
    leg = flight.legs[-1]
    begins = braked_takeover(leg, now, brake, 0.0)
    old = _ended(leg, begins, brake)
    replan = SpatialReplan(now, begins.time, names, None, True)
    reason = f"it found no way past {' and '.join(names)}, and hovers before it"
    return replace(
        flight, legs=(*flight.legs[:-1], old), replans=(*flight.replans, replan), reason=reason
    )
