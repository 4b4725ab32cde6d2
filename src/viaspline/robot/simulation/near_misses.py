"""What a driven body came nearer to than was asked, and whether its sensor could have shown that.

A robot can only keep clear of what it knows of in time: while it can still brake before it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats
from viaspline.mission.model import Mission
from viaspline.mission.robot_parts import RobotSpec
from viaspline.robot.perception.belief import Belief
from viaspline.robot.perception.lidar import LidarSensor
from viaspline.robot.run import Shortfall
from viaspline.robot.simulation.driven_motion import DrivenMotion
from viaspline.trajectory.limits import REACTION_S
from viaspline.world.world import World

UNNOTED_M = 1e-4
"""What is nearer than asked by less is not noted [m]."""

OUTLINE_STEP_M = 0.005
"""From place to place on a body's outline at which it is looked at what is near [m]."""

DIRECTIONS = 4096
"""In which the nearest place on a surface is looked for."""


@dataclass(frozen=True)
class _Thing:
    """Something that a body may come near to, alone in a world of its own."""

    name: str
    world: World
    on_map: bool


def near_misses(mission: Mission, world: World, motion: DrivenMotion) -> tuple[Shortfall, ...]:
    """All that a body came nearer to than was asked, the nearest first.

    Args:
        mission: What was asked.
        world: Everything that was there.
        motion: What was driven.

    Example:
        >>> mission = Mission.model_validate({
        ...     "world": {"unseen": [{"circle": {"center": [5, 0.7], "radius": 0.3}}]},
        ...     "robot": {
        ...         "radius_m": 0.3, "clearance_m": 0.2, "sensor": {"lidar": {"range_m": 0.45}},
        ...     },
        ...     "route": {"start": [0, 0], "goal": [9, 0]},
        ... })
        >>> x, still = np.linspace(0, 9, 91), np.zeros(91)
        >>> motion = DrivenMotion(x, np.column_stack((x, still)), still, still + 1, x, step=0.1)
        >>> [near] = near_misses(mission, World.everything(mission), motion)
        >>> round(near.clearance, 3), near.seen_in_time, round(near.shown, 3)
        (0.1, False, 4.8)
    """
    robot = mission.robot
    found = []
    for thing in _things(mission, world, motion):
        gaps = _gaps(robot, thing.world, motion)
        k = int(gaps.argmin())
        if gaps[k] < robot.clearance_m - UNNOTED_M:
            found.append(_shortfall(mission, world, motion, thing, k, float(gaps[k])))
    return tuple(sorted(found, key=lambda one: one.clearance))


def _things(mission: Mission, world: World, motion: DrivenMotion) -> Iterator[_Thing]:
    """What stands near to what was driven, and the edges of the world."""
    reach = mission.robot.outer_radius + mission.robot.clearance_m
    close = motion.places[world.distance(motion.places) < reach]
    if not len(close):
        return
    low, high = close.min(axis=0) - reach, close.max(axis=0) + reach
    mapped = set(World.known(mission).names)
    for obstacle in world.near((*low.tolist(), *high.tolist())).obstacles:
        name = World([obstacle]).name(0)
        yield _Thing(name, World([obstacle]), name in mapped)
    edges = World(bounds=world.bounds, fences=world.fences, corridor=world.corridor)
    distances, nearest = edges.nearest(close)
    yield _Thing(edges.name(int(nearest[distances.argmin()])), edges, on_map=True)


def _gaps(robot: RobotSpec, thing: World, motion: DrivenMotion) -> Floats:
    """Distance between the body and a thing at every moment [m], shape (n,)."""
    if robot.footprint is None:
        return np.asarray(thing.distance(motion.places) - robot.radius_m)
    return np.asarray(thing.body_distance(motion.places, motion.headings, robot.footprint))


def _shortfall(
    mission: Mission, world: World, motion: DrivenMotion, thing: _Thing, k: int, gap: float
) -> Shortfall:
    """What is to be said of a thing to which the body was nearest at moment ``k``."""
    surface = _surface_at(mission.robot, thing.world, motion, k)
    needed = _needed_by(mission.robot, motion, surface, k)
    shown = 0.0 if thing.on_map else _first_shown(mission, world, thing.world, motion, surface)
    in_time = shown is not None and needed is not None and shown <= needed
    return Shortfall(
        obstacle=thing.name,
        on_map=thing.on_map,
        clearance=gap,
        required=mission.robot.clearance_m,
        time=float(motion.times[k]),
        at=tuple(motion.places[k].tolist()),
        surface_at=(float(surface[0]), float(surface[1])),
        shown=shown,
        needed_by=needed,
        seen_in_time=in_time or thing.on_map,
    )


def _surface_at(robot: RobotSpec, thing: World, motion: DrivenMotion, k: int) -> Floats:
    """The place on a thing's surface that is nearest to the body at moment ``k`` [m], (2,)."""
    body = motion.places[k : k + 1]
    if robot.footprint is not None:
        outline = shapely.segmentize(shapely.Polygon(robot.footprint).exterior, OUTLINE_STEP_M)
        corners = shapely.get_coordinates(outline)
        c, s = math.cos(motion.headings[k]), math.sin(motion.headings[k])
        body = motion.places[k] + corners @ np.array([[c, s], [-s, c]])
    distances = thing.distance(body)
    nearest = int(np.abs(distances).argmin())
    angles = np.linspace(0.0, 2.0 * np.pi, DIRECTIONS, endpoint=False)
    rays = np.column_stack((np.cos(angles), np.sin(angles)))
    ring = body[nearest] + abs(float(distances[nearest])) * rays
    return np.asarray(ring[np.abs(thing.distance(ring)).argmin()])


def _needed_by(robot: RobotSpec, motion: DrivenMotion, surface: Floats, k: int) -> float | None:
    """Until when the robot could still have braked before it was too near to a place [s].

    None if it was so from the start.
    """
    gaps = _gaps_to(robot, motion, surface)
    clear = np.flatnonzero(gaps[: k + 1] >= robot.clearance_m - UNNOTED_M)
    if not clear.size:
        return None
    last = int(clear[-1])
    late = (
        REACTION_S if robot.drive is None else REACTION_S + robot.drive.delay_s + robot.drive.lag_s
    )
    brake = robot.max_brake_mps2 or robot.max_accel_mps2
    speeds = motion.speeds[: last + 1]
    stops = motion.distances[: last + 1] + speeds * (late + 0.5 * speeds / brake)
    in_time = np.flatnonzero(stops <= motion.distances[last + 1])
    return float(motion.times[in_time[-1]]) if in_time.size else None


def _gaps_to(robot: RobotSpec, motion: DrivenMotion, place: Floats) -> Floats:
    """Distance between the body and a place at every moment [m], shape (n,)."""
    away = place - motion.places
    if robot.footprint is None:
        return np.asarray(np.hypot(*away.T) - robot.radius_m)
    c, s = np.cos(motion.headings), np.sin(motion.headings)
    ahead, aside = c * away[:, 0] + s * away[:, 1], c * away[:, 1] - s * away[:, 0]
    body = shapely.Polygon(robot.footprint)
    return np.asarray(shapely.distance(shapely.points(ahead, aside), body))


def _first_shown(
    mission: Mission, world: World, thing: World, motion: DrivenMotion, surface: Floats
) -> float | None:
    """When the robot's sensor first could show a place on the surface of a thing [s]."""
    sensor = mission.robot.sensor
    if sensor is None:
        return None
    looks = motion.looks
    if sensor.lidar is None:
        shows = thing.distance(motion.places[looks]) <= sensor.reach
        return float(motion.times[looks[shows.argmax()]]) if shows.any() else None
    lidar = LidarSensor(world.obstacles, sensor.lidar.model_copy(update={"noise_m": 0.0}))
    covered = Belief.at_start(World(), mission.robot).cell_size
    for k in looks[_may_show(mission.robot, motion, looks, surface, covered)].tolist():
        scan = lidar.scan(tuple(motion.places[k].tolist()), float(motion.headings[k]))
        if len(scan.hits) and np.hypot(*(scan.hits - surface).T).min() <= covered:
            return float(motion.times[k])
    return None


def _may_show(
    robot: RobotSpec, motion: DrivenMotion, looks: NDArray[np.int64], surface: Floats, near: float
) -> NDArray[np.bool_]:
    """At which looks a place within ``near`` of a surface is in the field of view, (n,)."""
    assert robot.sensor is not None and robot.sensor.lidar is not None  # noqa: PT018
    lidar = robot.sensor.lidar
    away = surface - motion.places[looks]
    far = np.hypot(*away.T)
    turned = np.arctan2(away[:, 1], away[:, 0]) - motion.headings[looks]
    turned = np.abs(np.remainder(turned + np.pi, 2.0 * np.pi) - np.pi)
    spread = np.arcsin(np.minimum(near / np.maximum(far, near), 1.0))
    return np.asarray(
        (far <= lidar.range_m + near) & (turned <= 0.5 * math.radians(lidar.fov_deg) + spread)
    )
