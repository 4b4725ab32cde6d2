"""A mission in space flown through the world as it is, with what isn't on its map.

The robot follows its path exactly. As soon as its sensor sees something in the way it looks for
another path from a place a little ahead, where that joins without a corner; if there is none that
it can fly into at its speed, it stops and looks from there.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Final

import numpy as np

from viaspline.errors import GeometryError
from viaspline.formats.asked_for import AskedMission, asked_mission
from viaspline.handed_in import check_kind, seed_from, time_from
from viaspline.mission.model import Mission
from viaspline.mission.space.flight_places import flight_places
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.among.timed_past import WATCHED_S, WATCHED_SHARE
from viaspline.space.online.flight import Flight
from viaspline.space.online.flown_leg import FlownLeg
from viaspline.space.online.lead_past import reacted, with_seen
from viaspline.space.online.recorded_flight import recorded, recorded_among
from viaspline.space.online.sightings import UnseenSolid, first_sighting
from viaspline.space.online.solid_sensor import SolidSensor
from viaspline.space.online.solid_tracks import SolidTracks
from viaspline.space.online.watch_flight import FlightWatch, watch_flight
from viaspline.space.plan_spatial import plan_spatial
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_problem import SpatialProblem
from viaspline.space.spatial_request import spatial_problem_of, spatial_world_of
from viaspline.space.spatial_run import SpatialRun
from viaspline.world.space.spatial_world import SpatialWorld

STEP_S: Final = 0.1
"""Between two looks of the sensor."""

MAX_REPLANS: Final = 200


def fly(plan: SpatialPlan | AskedMission, step: float = STEP_S, seed: int = 0) -> SpatialRun:
    """Fly a plan.

    Args:
        plan: It; or a mission in space, or the file of one, which is planned first.
        step: From one moment of the result to the next, and between two looks [s].
        seed: Of the noise of the sensor.

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
    step, seed = time_from("step", step), seed_from("seed", seed)
    mission = plan.mission
    sensor = mission.robot.sensor
    flight = Flight(
        (FlownLeg(plan.path, plan.trajectory, plan.yaw, np.inf, plan.moving),),
        (_unrolled(spatial_problem_of(mission)),), mission, _unseen(mission, plan.world),
    )  # fmt: skip
    moves = bool(mission.world.unseen_moving) or mission.robot.moving is not None
    if (flight.unseen or moves) and sensor is None:
        raise GeometryError("there are unseen obstacles and no sensor; give robot.sensor.range_m")
    everything = with_seen(mission, flight.unseen)
    world = spatial_world_of(everything, flight_places(mission))
    if sensor is None or not moves:
        flight = _flown(flight, 0.0 if sensor is None else sensor.reach, step)
        return recorded(plan, flight, world, step)
    law = plan.trajectory
    until = law.start_time + WATCHED_SHARE * law.duration + WATCHED_S
    unseen = MovingSolid.unseen_of(mission, law.start_time, until + 1.0)
    eyes = SolidSensor(unseen, sensor.reach, sensor.velocity_noise_mps, seed)
    flight = replace(flight, tracks=SolidTracks(eyes.velocity_noise))
    flight = watch_flight(flight, FlightWatch(eyes, mission.robot.moving, step, until))
    return recorded_among(plan, flight, world, eyes, step)


def _flown(flight: Flight, reach: float, step: float) -> Flight:
    """A flight past what stands and isn't on the map, from one sighting to the next."""
    now = flight.legs[0].law.start_time
    for _ in range(MAX_REPLANS):
        now, seen = first_sighting(flight.ahead_of(now), flight.unseen, reach, now, step)
        if not seen:
            break
        flight = reacted(flight, now, seen)
        if flight.reason:
            break
    return flight


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
