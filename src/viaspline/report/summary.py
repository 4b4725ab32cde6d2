"""A mission in a few words; light enough for ``viaspline check``."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

from viaspline.maps.grid import Grid
from viaspline.mission.corridor_spec import Corridor
from viaspline.mission.model import Mission
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.sensor_spec import Sensor
from viaspline.mission.shapes.obstacle import SHAPES, Obstacle
from viaspline.mission.world_spec import WorldSpec
from viaspline.report.flight_words import flight_words, height_words
from viaspline.report.units import metres

MAX_MAPS_NAMED = 4  # in the words about a world, before the rest is only counted


def tension(mission: Mission) -> float | list[float] | None:
    """Eq. (7)'s tension, whichever of its two names the mission uses; None when it uses none."""
    spline = mission.spline
    assert spline.tension != "auto", "a plan's mission has the tension that was advised"
    if spline.tension is not None:
        return list(spline.tension) if isinstance(spline.tension, tuple) else spline.tension
    if spline.slack is None:
        return None
    if isinstance(spline.slack, tuple):
        return [1 - 2 * slack for slack in spline.slack]
    return 1 - 2 * spline.slack


def spline_words(mission: Mission) -> str:
    """How the curve is asked to be; the tension by both of its names."""
    spline = mission.spline
    if mission.route.corridor is not None and mission.route.corridor.line is not None:
        return "least curvature along the corridor"
    value = None if spline.tension == "auto" else tension(mission)
    value = 0.0 if value is None else value
    if spline.tension == "auto":
        pull = "the tension that is advised"
    elif isinstance(value, list):
        pull = f"tension {min(value):g} to {max(value):g} by span"
    else:
        pull = f"tension {value:g} (slack {(1 - value) / 2:g})"
    bends = "continuous curvature" if mission.tangents == "continuous" else "cardinal tangents"
    return f"{pull}, {spline.knots} knots, {bends}"


def body_words(robot: RobotSpec) -> str:
    """The robot's body and how tightly it turns.

    >>> body_words(RobotSpec(radius_m=0.4, min_turn_radius_m=2))
    'robot of radius 0.4 m with a turning circle of 2 m'
    """
    body = f"of radius {robot.radius_m:g} m"
    if robot.footprint is not None:
        (x0, x1), (y0, y1) = ((min(c), max(c)) for c in zip(*robot.footprint, strict=True))
        body = f"of {x1 - x0:.3g} m x {y1 - y0:.3g} m"
    turn = robot.turn_radius
    circle = "" if turn is None else f" with a turning circle of {turn:.3g} m"
    return f"robot {body}{circle}"


def summary(mission: Mission) -> list[tuple[str, str]]:
    """Route, world, robot and spline: what each of them is, on one line."""
    return [
        ("route", _route(mission)),
        ("world", world_words(mission.world, mission.route.corridor)),
        ("robot", robot_words(mission.robot)),
        ("spline", spline_words(mission) + _stated_words(mission)),
    ]


def _stated_words(mission: Mission) -> str:
    """That no tension is stated, and that lines and turns compete with the spline then."""
    is_led = mission.route.corridor is not None and mission.route.corridor.line is not None
    if is_led or mission.spline.tension == "auto" or tension(mission) is not None:
        return ""
    return ", as none is stated; lines and turns where they are sooner"


def _route(mission: Mission) -> str:
    points = [point for _, point in mission.route.points()]
    if mission.is_spatial:
        return ", ".join([counted(len(points), "point"), *flight_words(mission)])
    places = [point.at for point in points] + ([points[0].at] if mission.route.closed else [])
    straight = sum(math.dist(a, b) for a, b in pairwise(places))
    words = [counted(len(points), "point"), f"{metres(straight, 1)} from point to point"]
    if mission.route.closed:
        words.insert(1, "back to the start")
        if mission.route.laps > 1:
            words.append(f"{mission.route.laps} laps")
    dwells = [point.dwell_s for point in points if point.dwell_s > 0]
    if dwells:
        words.append(f"{counted(len(dwells), 'station')} with stops of {sum(dwells):g} s together")
    if len(points[0].at) == 3:
        words.append("with heights")
    return ", ".join(words)


def world_words(world: WorldSpec, corridor: Corridor | None = None) -> str:
    """What a world holds, and how far it goes.

    >>> world_words(WorldSpec(bounds=(0, 0, 9, 5)))
    'no known obstacles, bounds 9 m x 5 m'
    """
    grids = [obstacle.grid for obstacle in (*world.known, *world.unseen) if obstacle.grid]
    words = [map_words(grid) for grid in grids[:MAX_MAPS_NAMED]]
    if len(grids) > MAX_MAPS_NAMED:
        words.append(f"{len(grids) - MAX_MAPS_NAMED} more maps")
    for obstacles, kind in ((world.standing, "known"), (world.unseen_standing, "unseen")):
        shapes = [obstacle for obstacle in obstacles if obstacle.grid is None]
        if shapes or (kind == "known" and not grids):
            words.append(_obstacles(shapes, kind))
    moving = [(world.moving, "known"), (world.unseen_moving, "unseen")]
    words += [_obstacles(those, f"{kind} moving") for those, kind in moving if those]
    if world.bounds is not None:
        x0, y0, x1, y1 = world.bounds
        words.append(f"bounds {x1 - x0:g} m x {y1 - y0:g} m")
    if world.fences:
        words.append(counted(len(world.fences), "fence"))
    words += height_words(world)
    if corridor is not None:
        words.append(_corridor(corridor))
    elif world.bounds is None and not world.fences:
        words.append("no bounds")
    return ", ".join(words)


def _corridor(corridor: Corridor) -> str:
    """A corridor in a few words."""
    if corridor.line is None:
        return f"a corridor of {corridor.left_m:g} m (left) and {corridor.right_m:g} m (right)"
    widths = [right + left for _, _, right, left in corridor.line]
    name = "" if corridor.csv is None else f" {Path(corridor.csv).name}"
    return f"the corridor{name} of {len(widths)} rows, {min(widths):g} to {max(widths):g} m wide"


def map_words(grid: Grid) -> str:
    """An occupancy grid in a few words.

    Example:
        >>> map_words(Grid([[0, 1, 1], [0, 0, 0]], 0.05, source="maps/depot.yaml"))
        'map maps/depot.yaml: 3 x 2 cells of 0.05 m'
        >>> map_words(Grid([[0, 1, 1]], 1.0, unknown=[[0, 0, 1]]))
        'map: 3 x 1 cells of 1 m (33 % unknown)'
    """
    name = "map" if grid.source is None else f"map {grid.source}"
    unknown = "" if grid.unknown is None else f" ({100 * grid.unknown.mean():.0f} % unknown)"
    size = f"{grid.width} x {grid.height} cells of {grid.resolution:g} m"
    return f"{name}: {size}{unknown}"


def _obstacles(obstacles: Sequence[Obstacle], kind: str) -> str:
    given = Counter(key for key in SHAPES for o in obstacles if getattr(o, key) is not None)
    named = {"box": "cuboid", "voxels": "voxel map"}
    parts = [counted(n, named.get(what, what)) for what, n in given.items()]
    of = f" ({' and '.join(parts)})" if parts else ""
    return f"{counted(len(obstacles), f'{kind} obstacle')}{of}"


def robot_words(robot: RobotSpec) -> str:
    """Body, limits and sensor of a robot.

    >>> robot_words(RobotSpec())
    'of radius 0.5 m, clearance 0.5 m, at most 2 m/s and 1 m/s²'
    """
    words = [
        body_words(robot).removeprefix("robot "),
        f"clearance {robot.clearance_m:g} m",
        f"at most {robot.max_speed_mps:g} m/s and {robot.max_accel_mps2:g} m/s²",
    ]
    if robot.sensor is not None:
        words.append(_sensor(robot.sensor))
    return ", ".join(words)


def _sensor(sensor: Sensor) -> str:
    if sensor.lidar is None:
        return f"sees {sensor.reach:g} m far"
    lidar = sensor.lidar
    noise = f" and {lidar.noise_m:g} m of noise" if lidar.noise_m > 0 else ""
    beams = f"{counted(lidar.beams, 'beam')} of {lidar.range_m:g} m in {lidar.fov_deg:g}°"
    return f"a lidar with {beams}{noise}"


def counted(number: int, what: str) -> str:
    """So many of something.

    >>> counted(1, "robot"), counted(0, "fence")
    ('1 robot', 'no fences')
    """
    return f"{number or 'no'} {what}{'' if number == 1 else 's'}"
