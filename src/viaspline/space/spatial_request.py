"""From a mission in space to what the planner asks for."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.model import Mission
from viaspline.mission.route_spec import ViaPoint
from viaspline.mission.shapes.solids import Place
from viaspline.mission.space.flight_places import FlightPlaces, flight_places
from viaspline.mission.space.yaw_spec import FixedYaw
from viaspline.mission.spline_spec import SplineSpec
from viaspline.space.laying.laid_route import CurveShape
from viaspline.space.spatial_problem import SpatialProblem, SpatialVia
from viaspline.space.timing.spatial_limits import SpatialLimits
from viaspline.space.timing.yaw_profile import Facing, FacingAlong, FacingFixed, FacingPlace
from viaspline.trajectory.limits import Limits
from viaspline.world.space.height_band import HeightBand
from viaspline.world.space.spatial_world import SpatialWorld

MOST_LIFTS: Final = 50
"""How often the place over a landing is lifted: each time by what it lacks, over steep ground."""

LIFT_M: Final = 1e-3
"""By so much more."""


def spatial_problem_of(mission: Mission) -> SpatialProblem:
    """What a mission in space asks for.

    Args:
        mission: It, sound.

    >>> mission = Mission.model_validate({
    ...     "world": {"ground": {"flat_m": 0}},
    ...     "route": {"start": [0, 0], "takeoff": {"to_agl_m": 10}, "land": {"at": [50, 0]}},
    ... })
    >>> problem = spatial_problem_of(mission)
    >>> [(via.name, via.at.tolist()) for via in problem.vias]
    [('start', [0.0, 0.0, 10.0]), ('goal', [50.0, 0.0, 10.0])]
    """
    robot, route = mission.robot, mission.route
    places = flight_places(mission)
    vias = list(_vias(mission, places))
    problem = SpatialProblem(
        world=spatial_world_of(mission, places),
        vias=vias,
        clearance=robot.clearance_m + (robot.tracking_error_m or 0.0),
        radius=robot.radius_m if robot.half_height_m is None else 0.0,
        limits=spatial_limits_of(mission),
        shape=CurveShape(
            _tensions(mission.spline, len(vias) - 1), mission.spline.knots, mission.tangents
        ),
        keeps_spline=mission.spline.has_own_tension or mission.tangents == "cardinal",
        objective=route.optimise,
        facing=_facing(route.yaw),
        takeoff=None if places.takeoff is None else np.array(places.start),
        landing=None if places.landing is None else np.array(places.landing),
        laps=route.laps if route.closed else 1,
        zones=mission.world.speed_zones,
    )
    if places.landing is None or route.closed or route.goal is not None:
        return problem
    return replace(problem, vias=[*vias[:-1], _lifted(vias[-1], problem)])


def _lifted(top: SpatialVia, problem: SpatialProblem) -> SpatialVia:
    """The place over a landing, as high as the ground there asks for: it may lie uphill."""
    world, at = problem.world, top.at.copy()
    ground = float(world.ground_at(at[None])[0])
    least = -math.inf if math.isnan(ground) else ground + world.band.least_above_ground
    at[2] = max(at[2], least, world.band.lowest)
    for _ in range(MOST_LIFTS):
        distance, nearest = world.nearest(at[None])
        lacking = problem.required - float(distance[0])
        if lacking <= 0.0 or int(nearest[0]) != len(world.names):
            break  # of what else is there it is said that it is in the way
        at[2] += lacking + LIFT_M
    return replace(top, at=at)


def spatial_limits_of(mission: Mission) -> SpatialLimits:
    """The limits of a mission's robot in space.

    >>> mission = Mission.model_validate({"robot": {"max_climb_mps": 1.5},
    ...     "route": {"start": [0, 0, 5], "goal": [9, 0, 5]}})
    >>> spatial_limits_of(mission).descent
    1.5
    """
    robot = mission.robot
    rate = robot.max_yaw_rate_degps
    along = Limits.of(robot)
    return SpatialLimits(
        along=along,
        climb=robot.climb_speed if robot.climb_speed < robot.max_speed_mps else None,
        descent=robot.descent_speed if robot.descent_speed < robot.max_speed_mps else None,
        vertical_accel=_binding_vertical_accel(robot.max_vertical_accel_mps2, along),
        yaw_rate=None if rate is None else math.radians(rate),
    )


def _binding_vertical_accel(asked: float | None, along: Limits) -> float | None:
    """A limit of the acceleration up and down [m/s²], if the others together allow more.

    Up and down a drive may speed up and bend at once, so the one along the path and the one across
    it add up as the sides of a right angle do.
    """
    if asked is None or along.max_lateral_accel is None:
        return asked
    most = math.hypot(max(along.max_accel, along.brake), along.max_lateral_accel)
    return asked if asked < most else None


def spatial_world_of(mission: Mission, places: FlightPlaces) -> SpatialWorld:
    """The known world of a mission in space.

    Args:
        mission: It.
        places: Of its route; home counts for the altitude.
    """
    world, robot = mission.world, mission.robot
    solids = [obstacle.solid() for obstacle in world.standing]
    names = [
        obstacle.called(k) for k, obstacle in enumerate(world.known) if obstacle.motion is None
    ]
    ground = world.ground
    half = robot.half_height_m
    return SpatialWorld.of(
        solids,
        names,
        ground=None if ground is None else ground.terrain or ground.flat_m,
        bounds=world.bounds,
        core_radius=0.0 if half is None else robot.radius_m,
        core_half_height=0.0 if half is None else half,
        nodata="blocked" if ground is None else ground.nodata,
        fences=[(ring,) for ring in world.fences],
        band=_band(mission, places.home),
    )


def _band(mission: Mission, home: float) -> HeightBand:
    altitude = mission.world.altitude
    if altitude is None:
        return HeightBand()
    low = -math.inf if altitude.min_m is None else altitude.min_m
    high = math.inf if altitude.max_m is None else altitude.max_m
    if altitude.above == "ground":
        ground = mission.world.ground
        if ground is None:
            return HeightBand(lowest=low, highest=high)
        return HeightBand(least_above_ground=low, most_above_ground=high)
    zero = home if altitude.above == "home" else 0.0
    return HeightBand(lowest=zero + low, highest=zero + high)


def _vias(mission: Mission, places: FlightPlaces) -> Iterator[SpatialVia]:
    """The via points between take-off and landing."""
    route = mission.route
    first = places.start if places.takeoff is None else places.takeoff
    yield _via(route.start, route.start.name or "start", first, 0, rests=True)
    for k, (point, place) in enumerate(zip(route.via, places.via, strict=True)):
        yield _via(point, point.name or f"via {k + 1}", place, k + 1)
    last = places.via[-1] if places.via else first
    index = len(route.via) + 1
    if route.closed:
        yield _via(route.start, route.start.name or "start", first, index, rests=True)
    elif route.goal is not None and places.goal is not None:
        yield _via(route.goal, route.goal.name or "goal", places.goal, index, rests=True)
    elif places.landing is not None:
        top = (places.landing[0], places.landing[1], max(last[2], places.landing[2]))
        yield SpatialVia("goal", np.array(top), index, 0.0)


def _via(
    point: ViaPoint, name: str, place: Place, index: int, *, rests: bool = False
) -> SpatialVia:
    heading = getattr(point, "heading_deg", None)
    if point.gate is not None:
        heading = point.gate.facing_deg
    look = None if point.look_at is None else (point.look_at[0], point.look_at[1])
    dwell = point.dwell_s if rests or point.dwell_s > 0.0 else None
    return SpatialVia(name, np.array(place), index, dwell, _level(heading), look)


def _level(heading_deg: float | None) -> Floats | None:
    """The level unit vector of a heading [deg]."""
    if heading_deg is None:
        return None
    heading = math.radians(heading_deg)
    return np.array([math.cos(heading), math.sin(heading), 0.0])


def _tensions(spline: SplineSpec, count: int) -> Floats:
    """The tension of each leg, shape (count,)."""
    if spline.slack is not None:
        return np.broadcast_to(1.0 - 2.0 * np.asarray(spline.slack, float), count).copy()
    if spline.tension is None or spline.tension == "auto":
        return np.zeros(count)
    return np.broadcast_to(np.asarray(spline.tension, float), count).copy()


def _facing(yaw: str | FixedYaw | None) -> Facing:
    if isinstance(yaw, FixedYaw):
        if yaw.to is not None:
            return FacingPlace(yaw.to[0], yaw.to[1])
        assert yaw.fixed_deg is not None  # one of the two is given
        return FacingFixed(math.radians(yaw.fixed_deg))
    return FacingAlong()
