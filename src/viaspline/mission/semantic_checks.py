"""What types can't say: the semantic checks, all of them, on whatever parts are sound."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import replace
from itertools import pairwise

from viaspline.mission.drives.drive import DRIVE_KINDS
from viaspline.mission.partial_mission import PartialMission
from viaspline.mission.parts import SplineSpec, ViaPoint
from viaspline.mission.unplaced_faults import Path, UnplacedFault, number, spell

SAME_PLACE = 1e-6
"""Points nearer to each other than this are one point [m]."""


def semantic_flaws(draft: PartialMission) -> list[UnplacedFault]:
    """Everything that is wrong with the meaning of a mission."""
    from viaspline.mission.clearances import clearance_flaws
    from viaspline.mission.corridors import corridor_flaws
    from viaspline.mission.polygon_checks import shape_flaws

    flaws = _bounds(draft)
    misshapen = shape_flaws(draft)
    flaws += misshapen
    flaws += _sides(draft)
    flaws += _names(draft)
    flaws += _sensor(draft)
    flaws += _footprint(draft)
    flaws += _drive(draft)
    flaws += _route(draft)
    flaws += _same_places(draft)
    flaws += _dimensions(draft)
    if draft.spline is not None:
        flaws += _spline(draft, draft.spline)
    strange = corridor_flaws(draft)
    flaws += strange
    if strange:
        draft = replace(draft, corridor=None)
    flaws += clearance_flaws(draft, {flaw.path[:3] for flaw in misshapen})
    return flaws


def _bounds(draft: PartialMission) -> list[UnplacedFault]:
    if draft.bounds is None:
        return []
    x_min, y_min, x_max, y_max = draft.bounds
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


def _sides(draft: PartialMission) -> list[UnplacedFault]:
    flaws = [
        UnplacedFault((*path, key), "a map of squares has no sides", "leave it out", at_key=True)
        for path, obstacle in draft.known + draft.unseen
        for key in ("pass_on", "never_pass_on")
        if obstacle.grid is not None and getattr(obstacle, key) is not None
    ]
    return flaws + [
        UnplacedFault(
            (*path, "never_pass_on"),
            f"contradicts pass_on: {obstacle.pass_on}",
            "give one of pass_on and never_pass_on",
        )
        for path, obstacle in draft.known + draft.unseen
        if obstacle.pass_on is not None and obstacle.pass_on == obstacle.never_pass_on
    ]


def _names(draft: PartialMission) -> list[UnplacedFault]:
    points = [(path, point.name) for path, point in draft.points if point is not None]
    obstacles = [(path, obstacle.name) for path, obstacle in draft.known + draft.unseen]
    return _repeated(points, "point") + _repeated(obstacles, "obstacle")


def _repeated(named: list[tuple[Path, str | None]], kind: str) -> list[UnplacedFault]:
    flaws = []
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
        flaws.append(
            UnplacedFault((*path, "name"), problem, f"give each {kind} its own, e.g. '{free}'")
        )
    return flaws


def _sensor(draft: PartialMission) -> list[UnplacedFault]:
    if not draft.unseen or draft.robot is None or draft.robot.sensor is not None:
        return []
    problem = "there are unseen obstacles, but the robot has no sensor to find them"
    remedy = "give robot.sensor: {range_m: 40}, or put them under world.known"
    return [UnplacedFault(("world", "unseen"), problem, remedy, at_key=True)]


def _footprint(draft: PartialMission) -> list[UnplacedFault]:
    if draft.robot is None or draft.robot.footprint is None:
        return []
    from viaspline.mission.footprint_check import footprint_flaw

    flaw = footprint_flaw(draft.robot.footprint)
    return [] if flaw is None else [flaw]


def _drive(draft: PartialMission) -> list[UnplacedFault]:
    if draft.robot is None or draft.robot.drive is None:
        return []
    drive = draft.robot.drive
    has_footprint = draft.robot.footprint is not None
    name = next(key for key in DRIVE_KINDS if getattr(drive, key) is not None)
    return [
        UnplacedFault(("robot", "drive", name, key), problem, remedy)
        for key, problem, remedy in drive.kind.contradictions(has_footprint=has_footprint)
    ]


def _route(draft: PartialMission) -> list[UnplacedFault]:
    flaws = []
    if draft.closed and draft.has_goal:
        ends_at_start = _distance(draft.points[0][1], draft.points[-1][1]) < SAME_PLACE
        what = "which is its start again" if ends_at_start else "but a closed route ends at start"
        flaws.append(
            UnplacedFault(
                ("route", "goal"),
                f"a closed route has a goal, {what}",
                "leave out goal" if ends_at_start else "leave out goal, or set closed: false",
                at_key=True,
            )
        )
    if draft.laps > 1 and draft.closed is False:
        problem = f"an open route can't be driven {draft.laps} times over"
        remedy = "set closed: true, or leave out laps"
        flaws.append(UnplacedFault(("route", "laps"), problem, remedy, at_key=True))
    if (
        draft.has_route
        and len(draft.points) < 2
        and not draft.is_line
        and draft.points[0][1] is not None
    ):
        problem = "a route needs at least two distinct points; this one has only its start"
        flaws.append(UnplacedFault(("route",), problem, "give goal: [x, y] or via: [[x, y], ...]"))
    return flaws


def _same_places(draft: PartialMission) -> list[UnplacedFault]:
    flaws = []
    for (before, a), (path, b) in pairwise(draft.points):
        if (gap := _distance(a, b)) < SAME_PLACE:
            flaws.append(_same_place(path, before, gap))
    if draft.closed and not draft.has_goal and len(draft.points) > 1:
        (start, a), (path, b) = draft.points[0], draft.points[-1]
        if (gap := _distance(a, b)) < SAME_PLACE and len(draft.points) > 2:
            problem = f"is the same place as {spell(start)}, to which a closed route returns anyway"
            flaws.append(UnplacedFault((*path, "at"), problem, "leave it out"))
    return flaws


def _same_place(path: Path, before: Path, gap: float) -> UnplacedFault:
    apart = "exactly" if gap == 0 else f"to within {gap:.1g} m"
    return UnplacedFault(
        (*path, "at"),
        f"is {apart} the same place as {spell(before)}, just before it: the route needs distinct "
        "points",
        "leave out one of the two (dwell_s makes the robot wait there)",
    )


def _distance(a: ViaPoint | None, b: ViaPoint | None) -> float:
    """The distance of two points [m]; infinite if it can't be said."""
    if a is None or b is None or len(a.at) != len(b.at):
        return math.inf
    return math.dist(a.at, b.at)


def _dimensions(draft: PartialMission) -> list[UnplacedFault]:
    sound = [(path, point) for path, point in draft.points if point is not None]
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
            "give all points of the route 2 coordinates, or all of them 3",
        )
        for path, point in sound
        if len(point.at) != usual
    ]


def _spline(draft: PartialMission, spline: SplineSpec) -> list[UnplacedFault]:
    flaws = []
    if spline.tension is not None and spline.slack is not None:
        flaws.append(
            UnplacedFault(
                ("spline", "slack"),
                "tension and slack are two names of one thing (slack = (1 - tension) / 2)",
                "give one of the two",
                at_key=True,
            )
        )
    for key, values in (("tension", spline.tension), ("slack", spline.slack)):
        if values is not None and values != "auto":
            flaws += _tensions(draft, key, values)
    return flaws


def _tensions(
    draft: PartialMission, key: str, values: float | tuple[float, ...]
) -> list[UnplacedFault]:
    flaws = []
    path: Path = ("spline", key)
    is_contradictory = draft.closed is None or (draft.closed and draft.has_goal)
    if isinstance(values, tuple) and draft.has_route and not is_contradictory:
        spans = len(draft.points) - (0 if draft.closed else 1)
        if len(values) != spans and spans > 0:
            problem = f"has {len(values)} values for {spans} {'span' if spans == 1 else 'spans'}"
            remedy = "give one number for all, or one for each span between points of the route"
            flaws.append(UnplacedFault(path, problem, remedy))
    for i, value in enumerate(values if isinstance(values, tuple) else (values,)):
        where = (*path, i) if isinstance(values, tuple) else path
        if key == "tension" and value > 1:
            problem = f"{number(value, 6)} is more than 1, which is already the polyline"
            flaws.append(UnplacedFault(where, problem, "it should be at most 1; 0 is Catmull-Rom"))
        if key == "slack" and value < 0:
            problem = f"{number(value, 6)} is less than 0, which is already the polyline"
            flaws.append(
                UnplacedFault(where, problem, "it should be 0 or more; 0.5 is Catmull-Rom")
            )
    return flaws
