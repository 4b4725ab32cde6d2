"""Where in space the points of a route are."""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.mission.mission_parts import MissionParts
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.route_spec import ViaPoint
from viaspline.mission.shapes.solids import Place
from viaspline.mission.space.ground_spec import GroundSpec


@dataclass(frozen=True)
class FlightPlaces:
    """The places of a route, each x, y, z of the robot's reference point [m].

    Attributes:
        start: Where it is at first; where it takes off and has no height, it stands on the ground.
        takeoff: Where it is when it has taken off; None if it begins in the air.
        via: The via points in order; a gate is its middle.
        goal: The goal; None if there is none.
        landing: Where it stands when it has landed; None if it doesn't land.
        home: How high the ground is under the start [m]; 0 if there is no ground.
    """

    start: Place
    takeoff: Place | None
    via: tuple[Place, ...]
    goal: Place | None
    landing: Place | None
    home: float


def flight_places(parts: MissionParts) -> FlightPlaces:
    """The places of a sound mission in space.

    >>> parts = MissionParts.model_validate({
    ...     "world": {"ground": {"flat_m": 100}},
    ...     "robot": {"radius_m": 0.4, "half_height_m": 0.2},
    ...     "route": {
    ...         "start": [0, 0],
    ...         "takeoff": {"to_agl_m": 10},
    ...         "via": [{"at": [50, 0], "agl_m": 20}],
    ...         "land": {"at": [90, 0]},
    ...     },
    ... })
    >>> places = flight_places(parts)
    >>> places.start, places.takeoff, places.via, places.landing
    ((0.0, 0.0, 100.2), (0.0, 0.0, 110.0), ((50.0, 0.0, 120.0),), (90.0, 0.0, 100.2))
    """
    route, ground, standing = parts.route, parts.world.ground, standing_height(parts.robot)
    x, y = route.start.at[:2]
    home = ground_height(ground, x, y)
    start = place_of(route.start, ground)
    takeoff: Place | None = None
    if route.takeoff is not None:
        takeoff = (x, y, home + route.takeoff.to_agl_m)
        start = (x, y, home + standing) if math.isnan(start[2]) else start
    landing: Place | None = None
    if route.land is not None:
        u, v = route.land.at
        landing = (u, v, ground_height(ground, u, v) + standing)
    return FlightPlaces(
        start=start,
        takeoff=takeoff,
        via=tuple(place_of(point, ground) for point in route.via),
        goal=None if route.goal is None else place_of(route.goal, ground),
        landing=landing,
        home=home,
    )


def standing_height(robot: RobotSpec) -> float:
    """How high the reference point is above the ground that the robot stands on [m]."""
    return robot.radius_m if robot.half_height_m is None else robot.half_height_m


def ground_height(ground: GroundSpec | None, x: float, y: float) -> float:
    """How high the ground is at a place [m]; 0 if there is none, NaN if nobody knows."""
    return 0.0 if ground is None else float(ground.heights_at((x, y)))


def place_of(point: ViaPoint, ground: GroundSpec | None) -> Place:
    """Where a point of the route is, x, y, z [m]; z is NaN if the point has no height.

    >>> place_of(ViaPoint(at=(1, 2), agl_m=5), GroundSpec(flat_m=40))
    (1.0, 2.0, 45.0)
    """
    x, y = point.at[:2]
    if point.agl_m is not None:
        return x, y, ground_height(ground, x, y) + point.agl_m
    return x, y, point.at[2] if len(point.at) == 3 else math.nan
