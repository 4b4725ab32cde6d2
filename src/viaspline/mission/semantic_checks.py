"""What types can't say: the semantic checks, all of them, on whatever parts are sound.

Tested through ``mission/test_model``.
"""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import replace

from viaspline.mission.drives.drive import DRIVE_KINDS
from viaspline.mission.partial_mission import PartialMission
from viaspline.mission.route_spec import MAX_POINTS_DRIVEN, ViaPoint
from viaspline.mission.same_places import SAME_POINT_M, PointPlace, same_place_faults
from viaspline.mission.spline_spec import (
    LOOSEST_SLACK,
    LOOSEST_TENSION,
    POLYLINE_SLACK,
    POLYLINE_TENSION,
    SplineSpec,
)
from viaspline.mission.unplaced_faults import Path, UnplacedFault, number, spell


def semantic_faults(partial: PartialMission) -> list[UnplacedFault]:
    """Everything that is wrong with the meaning of a mission."""
    from viaspline.mission.clearances import clearance_faults
    from viaspline.mission.space.spatial_checks import spatial_faults

    of_world, misshapen = world_faults(partial)
    of_route, is_strange = route_faults(partial)
    if is_strange:
        partial = replace(partial, corridor=None)
    if partial.space is None:
        in_its_place = clearance_faults(partial, misshapen)
    else:
        in_its_place = spatial_faults(partial, partial.space, misshapen)
    return [*of_world, *_sensor(partial), *robot_faults(partial), *of_route, *in_its_place]


def world_faults(partial: PartialMission) -> tuple[list[UnplacedFault], set[Path]]:
    """What is wrong with a world by itself, and the paths of what has no usable shape."""
    from viaspline.mission.motion_checks import motion_faults
    from viaspline.mission.shape_checks import shape_faults

    misshapen = shape_faults(partial)
    obstacles = [(path, obstacle.name) for path, obstacle in partial.known + partial.unseen]
    faults = [*_bounds(partial), *misshapen, *motion_faults(partial), *_sides(partial)]
    return [*faults, *_repeated(obstacles, "obstacle")], {fault.path[:3] for fault in misshapen}


def robot_faults(partial: PartialMission) -> list[UnplacedFault]:
    """What is wrong with a robot by itself."""
    return [*_footprint(partial), *_drive(partial)]


def route_faults(partial: PartialMission) -> tuple[list[UnplacedFault], bool]:
    """What is wrong with a route and its spline by themselves, and whether its corridor is."""
    from viaspline.mission.corridors import corridor_faults

    points = [(path, point.name) for path, point in partial.points if point is not None]
    faults = [*_repeated(points, "point"), *_route(partial)]
    if partial.space is None:
        faults += [*_same_places(partial), *_dimensions(partial), *_heights(partial)]
    if partial.spline is not None:
        faults += _spline(partial, partial.spline)
    strange = corridor_faults(partial)
    return [*faults, *strange], bool(strange)


def _bounds(partial: PartialMission) -> list[UnplacedFault]:
    if partial.bounds is None:
        return []
    x_min, y_min, x_max, y_max = partial.bounds
    path: Path = ("world", "bounds")
    return [
        UnplacedFault(
            path,
            f"{axis}_min {number(low, 6)} is not less than {axis}_max {number(high, 6)}",
            "bounds are [x_min, y_min, x_max, y_max]",
        )
        for axis, low, high in (("x", x_min, x_max), ("y", y_min, y_max))
        if low >= high
    ]


def _sides(partial: PartialMission) -> list[UnplacedFault]:
    faults = [
        UnplacedFault((*path, key), f"a map of {parts} has no sides", "leave it out", at_key=True)
        for path, obstacle in partial.known + partial.unseen
        if obstacle.grid is not None or obstacle.voxels is not None
        for parts in ["squares" if obstacle.voxels is None else "voxels"]
        for key in ("pass_on", "never_pass_on")
        if getattr(obstacle, key) is not None
    ]
    return faults + [
        UnplacedFault(
            (*path, "never_pass_on"),
            f"contradicts pass_on: {obstacle.pass_on}",
            "give one of pass_on and never_pass_on",
        )
        for path, obstacle in partial.known + partial.unseen
        if obstacle.pass_on is not None and obstacle.pass_on == obstacle.never_pass_on
    ]


def _repeated(named: list[tuple[Path, str | None]], kind: str) -> list[UnplacedFault]:
    faults = []
    seen: dict[str, Path] = {}
    taken = Counter(name for _, name in named if name is not None)
    for path, name in named:
        if name is None:
            continue
        if name not in seen:
            seen[name] = path
            continue
        free = next(
            other for i in range(2, len(named) + 3) if (other := f"{name}-{i}") not in taken
        )
        taken[free] += 1
        problem = f"the name '{name}' is taken by {spell(seen[name])}"
        faults.append(
            UnplacedFault((*path, "name"), problem, f"give each {kind} its own, e.g. '{free}'")
        )
    return faults


def _sensor(partial: PartialMission) -> list[UnplacedFault]:
    if not partial.unseen or partial.robot is None or partial.robot.sensor is not None:
        return []
    problem = "there are unseen obstacles, but the robot has no sensor to find them"
    remedy = "give robot.sensor: {range_m: 40}, or put them under world.known"
    return [UnplacedFault(("world", "unseen"), problem, remedy, at_key=True)]


def _footprint(partial: PartialMission) -> list[UnplacedFault]:
    if partial.robot is None or partial.robot.footprint is None:
        return []
    from viaspline.mission.footprint_check import footprint_fault

    fault = footprint_fault(partial.robot.footprint)
    return [] if fault is None else [fault]


def _drive(partial: PartialMission) -> list[UnplacedFault]:
    if partial.robot is None or partial.robot.drive is None:
        return []
    drive = partial.robot.drive
    has_footprint = partial.robot.footprint is not None
    name = next(key for key in DRIVE_KINDS if getattr(drive, key) is not None)
    return [
        UnplacedFault(("robot", "drive", name, key), problem, remedy)
        for key, problem, remedy in drive.kind.contradictions(has_footprint=has_footprint)
    ]


def _route(partial: PartialMission) -> list[UnplacedFault]:
    faults = []
    if partial.closed and partial.has_goal:
        ends_at_start = _distance(partial.points[0][1], partial.points[-1][1]) < SAME_POINT_M
        what = "which is its start again" if ends_at_start else "but a closed route ends at start"
        faults.append(
            UnplacedFault(
                ("route", "goal"),
                f"a closed route has a goal, {what}",
                "leave out goal" if ends_at_start else "leave out goal, or set closed: false",
                at_key=True,
            )
        )
    if partial.laps > 1 and partial.closed is False:
        problem = f"an open route can't be driven {partial.laps} times over"
        remedy = "set closed: true, or leave out laps"
        faults.append(UnplacedFault(("route", "laps"), problem, remedy, at_key=True))
    if partial.laps > 1 and (driven := partial.laps * len(partial.points)) > MAX_POINTS_DRIVEN:
        problem = f"{partial.laps} laps of {len(partial.points)} points are {driven} points"
        remedy = f"drive fewer laps: at most {MAX_POINTS_DRIVEN} points are planned in one drive"
        faults.append(UnplacedFault(("route", "laps"), problem, remedy))
    if (
        partial.has_route
        and len(partial.points) < 2
        and not partial.is_line
        and not (partial.space is not None and partial.space.has_land)
        and partial.points[0][1] is not None
    ):
        problem = "a route needs at least two distinct points; this one has only its start"
        faults.append(UnplacedFault(("route",), problem, "give goal: [x, y] or via: [[x, y], ...]"))
    return faults


def _same_places(partial: PartialMission) -> list[UnplacedFault]:
    places = [
        PointPlace(path, point.at, rank)
        for rank, (path, point) in enumerate(partial.points)
        if point is not None
    ]
    closed = bool(partial.closed) and not partial.has_goal
    found = same_place_faults(places, in_given_order=partial.in_given_order, closed=closed)
    return list(found)


def _distance(a: ViaPoint | None, b: ViaPoint | None) -> float:
    """The distance of two points [m]; infinite if it can't be said."""
    if a is None or b is None or len(a.at) != len(b.at):
        return math.inf
    return math.dist(a.at, b.at)


def _dimensions(partial: PartialMission) -> list[UnplacedFault]:
    sound = [(path, point) for path, point in partial.points if point is not None]
    if not sound:
        return []
    counts = Counter(len(point.at) for _, point in sound)
    if len(counts) < 2:
        return []
    usual = 3 if counts[3] > counts[2] else 2
    model = next(path for path, point in sound if len(point.at) == usual)
    return [
        UnplacedFault(
            (*path, "at"),
            f"has {len(point.at)} coordinates, but {spell(model)} has {usual}",
            "give all points of the route 2 coordinates, or all of them 3; "
            "a comma ends a number: write 30.5 for 30,5",
        )
        for path, point in sound
        if len(point.at) != usual
    ]


def _heights(partial: PartialMission) -> list[UnplacedFault]:
    """Keys of a robot that is simulated in the plane, where points of the route have heights."""
    if not any(point is not None and len(point.at) == 3 for _, point in partial.points):
        return []
    return [
        UnplacedFault(
            (*partial.robot_path, key),
            "is for routes in the plane",
            "leave it out, or the heights of the route's points",
            at_key=True,
        )
        for key in ("drive", "localization")
        if partial.robot is not None and getattr(partial.robot, key) is not None
    ]


def _spline(partial: PartialMission, spline: SplineSpec) -> list[UnplacedFault]:
    faults = []
    if spline.tension is not None and spline.slack is not None:
        faults.append(
            UnplacedFault(
                ("spline", "slack"),
                "tension and slack are two names of one thing (slack = (1 - tension) / 2)",
                "give one of the two",
                at_key=True,
            )
        )
    for key, values in (("tension", spline.tension), ("slack", spline.slack)):
        if values is not None and values != "auto":
            faults += _tensions(partial, key, values)
    return faults


def _tensions(
    partial: PartialMission, key: str, values: float | tuple[float, ...]
) -> list[UnplacedFault]:
    faults = []
    path: Path = ("spline", key)
    is_contradictory = partial.closed is None or (partial.closed and partial.has_goal)
    if isinstance(values, tuple) and partial.has_route and not is_contradictory:
        lands = partial.space is not None and partial.space.has_land and not partial.has_goal
        spans = len(partial.points) - (0 if partial.closed or lands else 1)
        if len(values) != spans and spans > 0:
            given = f"{len(values)} {'value' if len(values) == 1 else 'values'}"
            problem = f"has {given} for {spans} {'span' if spans == 1 else 'spans'}"
            remedy = "give one number for all, or one for each span between points of the route"
            faults.append(UnplacedFault(path, problem, remedy))
    for i, value in enumerate(values if isinstance(values, tuple) else (values,)):
        where = (*path, i) if isinstance(values, tuple) else path
        if key == "tension" and value > POLYLINE_TENSION:
            problem = f"{number(value, 6)} is more than 1, which is already the polyline"
            faults.append(UnplacedFault(where, problem, "it should be at most 1; 0 is Catmull-Rom"))
        if key == "tension" and value < LOOSEST_TENSION:
            problem = f"{number(value, 6)} is out of range"
            remedy = f"it should be at least {number(LOOSEST_TENSION)}"
            faults.append(UnplacedFault(where, problem, remedy))
        if key == "slack" and value > LOOSEST_SLACK:
            problem = f"{number(value, 6)} is out of range"
            remedy = f"it should be at most {number(LOOSEST_SLACK)}"
            faults.append(UnplacedFault(where, problem, remedy))
        if key == "slack" and value < POLYLINE_SLACK:
            problem = f"{number(value, 6)} is less than 0, which is already the polyline"
            faults.append(
                UnplacedFault(where, problem, "it should be 0 or more; 0.5 is Catmull-Rom")
            )
    return faults
