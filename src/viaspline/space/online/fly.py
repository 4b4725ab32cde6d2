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
from viaspline.space.among.timed_past import proven_beside, solids_beside
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
        legs: What was flown, and at last what is, or is to be as soon as its law begins.
        problems: What each of them solves; the last one in the world as it is known.
        known: The mission with all that was seen on its map.
        unseen: What nobody has seen yet.
        replans: Where the path was changed.
        reason: Why it ended before the goal.
    """

    legs: tuple[FlownLeg, ...]
    problems: tuple[SpatialProblem, ...]
    known: Mission
    unseen: tuple[UnseenSolid, ...]
    replans: tuple[SpatialReplan, ...] = ()
    reason: str = ""

    @property
    def problem(self) -> SpatialProblem:
        """What the last leg solves."""
        return self.problems[-1]

    def ahead_of(self, now: float) -> tuple[FlownLeg, ...]:
        """What is flown from a time on [s], the leg that is under way first."""
        return self.legs[-1:] if self.legs[-1].law.start_time <= now else self.legs[-2:]

    def without_pending(self, now: float) -> _Flight:
        """It without a leg that was to begin after a time [s]."""
        if len(self.ahead_of(now)) == 1:
            return self
        under_way = replace(self.legs[-2], until=np.inf)
        return replace(
            self, legs=(*self.legs[:-2], under_way), problems=self.problems[:-1],
            replans=self.replans[:-1],
        )  # fmt: skip


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
        (FlownLeg(plan.path, plan.trajectory, plan.yaw, np.inf, plan.moving),),
        (_unrolled(spatial_problem_of(mission)),), mission, _unseen(mission, plan.world),
    )  # fmt: skip
    if flight.unseen and mission.robot.sensor is None:
        raise GeometryError("there are unseen obstacles and no sensor; give robot.sensor.range_m")
    reach = 0.0 if mission.robot.sensor is None else mission.robot.sensor.reach
    now = plan.trajectory.start_time
    for _ in range(MAX_REPLANS):
        now, seen = first_sighting(flight.ahead_of(now), flight.unseen, reach, now, step)
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
    unseen = tuple(one for one in flight.unseen if one not in seen)
    flight = replace(flight, known=known, unseen=unseen)
    if all(_is_passed_clear(flight, now, one) for one in seen):
        return flight
    names = tuple(one.name for one in seen)
    if len(flight.ahead_of(now)) > 1:  # a path that is given up before it began
        names = (*flight.replans[-1].obstacles, *names)
        flight = flight.without_pending(now)
    problem = replace(flight.problem, world=spatial_world_of(known, flight_places(known)))
    return _led_past(replace(flight, problems=(*flight.problems[:-1], problem)), now, names)


def _led_past(flight: _Flight, now: float, names: tuple[str, ...]) -> _Flight:
    """A flight on another path from where it can take it up; else one that ends where it stops."""
    known, problem, leg = flight.known, flight.problem, flight.legs[-1]
    brake = problem.limits.along.brake
    braked = (braked_takeover(leg, now, brake, share) for share in SPEED_SHARES)
    for begins in (smooth_takeover(leg, now, brake), *braked):
        ahead = _still_ahead(flight, begins)
        if not ahead:
            continue
        old = _ended(leg, begins, brake, known)
        if old.moving is not None and not old.moving.holds:
            continue
        found = replan_in_space(known, problem, leg, ahead, begins)
        if isinstance(found, NewLeg):
            return _taken_over(flight, now, begins, old, found, names)
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
    """Whether all that is still to be flown is clear of something."""
    problem = flight.problem
    for leg in flight.ahead_of(now):
        first, last = (
            leg.law.distance_at(time) for time in (now, min(leg.until, leg.law.end_time))
        )
        span = np.minimum([float(first), float(last)], leg.path.length)
        u, end = np.asarray(leg.path.parameter(span)).tolist()
        if u >= end:
            continue
        rest = leg.path.section(u, end)
        if not certify(rest, one.world, problem.clearance, radius=problem.radius).holds:
            return False
    return True


def _still_ahead(flight: _Flight, begins: Takeover) -> tuple[SpatialVia, ...]:
    """The via points after a take-over."""
    leg, problem = flight.legs[-1], flight.problem
    users = [via for via in leg.path.vias if via.kind == "user"]
    users = users[problem.takeoff is not None : len(users) - (problem.landing is not None)]
    distances = np.asarray(leg.path.distance([via.u for via in users]))
    later = distances > begins.distance + 1e-6
    return tuple(via for via, after in zip(problem.vias, later, strict=True) if after)


def _taken_over(
    flight: _Flight, now: float, begins: Takeover, old: FlownLeg, found: NewLeg,
    names: tuple[str, ...],
) -> _Flight:  # fmt: skip
    replan = SpatialReplan(now, begins.time, names, found.leg.path, begins.speed == 0.0)
    return replace(
        flight, legs=(*flight.legs[:-1], old, found.leg),
        problems=(*flight.problems, found.problem), replans=(*flight.replans, replan),
    )  # fmt: skip


def _ended(leg: FlownLeg, begins: Takeover, brake: float, known: Mission) -> FlownLeg:
    """A leg as it is flown until another one begins; where it brakes, proven again."""
    if begins.since >= begins.time or begins.time >= leg.law.end_time:
        return replace(leg, until=begins.time)
    distance, speed, _ = (float(value) for value in leg.law.state_at(begins.since))
    stop = braking(distance, speed, brake, begins.since)
    law = leg.law.followed_by(stop, leg.law.start_time)
    braked = replace(leg, law=law, until=begins.time)
    if not known.world.moving:
        return braked
    moving = solids_beside(known, braked.law, 0.0)
    return replace(braked, moving=proven_beside(leg.path, braked.law, 0.0, known, moving))


def _stopped(flight: _Flight, now: float, names: tuple[str, ...]) -> _Flight:
    """A flight that ends where the robot comes to rest."""
    brake = flight.problem.limits.along.brake
    leg = flight.legs[-1]
    begins = braked_takeover(leg, now, brake, 0.0)
    old = _ended(leg, begins, brake, flight.known)
    replan = SpatialReplan(now, begins.time, names, None, True)
    reason = f"it found no way past {' and '.join(names)}, and hovers before it"
    reason += _too_late(flight, now, begins)
    return replace(
        flight, legs=(*flight.legs[:-1], old), replans=(*flight.replans, replan), reason=reason
    )


def _too_late(flight: _Flight, now: float, begins: Takeover) -> str:
    """That it saw something too late to stop with the clearance that is asked for, if it did."""
    problem, leg, sensor = flight.problem, flight.legs[-1], flight.known.robot.sensor
    here = float(leg.law.distance_at(now))
    first, last = np.minimum([here, begins.distance], leg.path.length).tolist()
    if last <= first or sensor is None:
        return ""
    part = leg.path.section(*np.asarray(leg.path.parameter([first, last])).tolist())
    proof = certify(part, problem.world, problem.clearance, radius=problem.radius)
    if proof.holds:
        return ""
    speed = float(leg.law.speed_at(here))
    return (
        f"; it comes as near as {max(proof.clearance, 0.0):.2f} m, for from {speed:.1f} m/s it "
        f"takes {last - first:.1f} m to stop, and its sensor sees {sensor.reach:g} m: fly slower, "
        "or give it a longer range_m"
    )
