"""Has every point of a route in space exactly one height, that can be known?

Tested through ``mission/space/test_spatial_checks``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from viaspline.mission.partial_mission import PartialMission
from viaspline.mission.route_spec import ViaPoint
from viaspline.mission.space.altitude_checks import GROUND_REMEDY
from viaspline.mission.space.flight_places import ground_height
from viaspline.mission.space.spatial_parts import SpatialParts
from viaspline.mission.unplaced_faults import Path, UnplacedFault, number

START: Path = ("route", "start")


def point_height_faults(partial: PartialMission, space: SpatialParts) -> Iterator[UnplacedFault]:
    """What is wrong with how the heights of points are said."""
    for path, point in partial.points:
        if point is not None:
            yield from _faults(path, point, space)
    yield from _ends(partial, space)
    yield from _home(partial, space)


def _faults(path: Path, point: ViaPoint, space: SpatialParts) -> Iterator[UnplacedFault]:
    is_via = path[-2:-1] == ("via",)
    if point.gate is not None and not is_via:
        problem = f"the {path[-1]} can't be a gate"
        remedy = "put the gate among the via points, and the end behind it"
        yield UnplacedFault((*path, "gate"), problem, remedy, at_key=True)
    if point.agl_m is not None and len(point.at) == 3:
        problem = "has both a z and a height above ground"
        remedy = "leave out agl_m, or z: at: [x, y]"
        yield UnplacedFault((*path, "agl_m"), problem, remedy, at_key=True)
    if point.agl_m is not None and not space.has_ground:
        problem = "counts from the ground, but the world has none"
        yield UnplacedFault((*path, "agl_m"), problem, f"{GROUND_REMEDY}, or z in place of agl_m")
    takes_off = path == START and space.has_takeoff
    if len(point.at) == 2 and point.agl_m is None and not takes_off:
        x, y = (number(coordinate, 6) for coordinate in point.at)
        what = f"at: [{x}, {y}, 10]" + (", or agl_m: 10" if space.has_ground else "")
        if path == START:
            what += ", or route.takeoff: {to_agl_m: 10}"
        yield UnplacedFault((*path, "at"), "has no height, in a mission in space", f"give {what}")


def _ends(partial: PartialMission, space: SpatialParts) -> Iterator[UnplacedFault]:
    """A route that lands ends there."""
    if not space.has_land:
        return
    path: Path = ("route", "land")
    if partial.has_goal:
        problem = "the route ends at its goal, and where it lands"
        remedy = "leave out goal, or put it among the via points"
        yield UnplacedFault(path, problem, remedy, at_key=True)
    elif partial.closed:
        problem = "a closed route ends at its start, and this one lands"
        remedy = "leave out land, or closed"
        yield UnplacedFault(path, problem, remedy, at_key=True)


def _home(partial: PartialMission, space: SpatialParts) -> Iterator[UnplacedFault]:
    """Places whose ground has to be known, and isn't."""
    if space.ground is None or space.ground.terrain is None:
        return
    start = partial.points[0][1] if partial.points else None
    above_home = space.altitude is not None and space.altitude.above == "home"
    asked: list[tuple[Path, tuple[float, ...], str]] = []
    for path, point in partial.points:
        if point is not None and point.agl_m is not None and len(point.at) == 2:
            asked.append(((*path, "at"), point.at, "its height counts from the ground"))
    if start is not None and start.agl_m is None and (space.has_takeoff or above_home):
        why = "it takes off from the ground" if space.has_takeoff else "altitudes count from there"
        asked.append(((*START, "at"), start.at, why))
    if space.land is not None:
        asked.append((("route", "land", "at"), space.land.at, "it lands on the ground"))
    x0, y0, x1, y1 = (number(edge, 3) for edge in space.ground.terrain.extent)
    for path, (x, y, *_), why in asked:
        if math.isnan(ground_height(space.ground, x, y)):
            problem = f"{why}, but nobody knows how high that is here"
            remedy = f"the terrain reaches from ({x0}, {y0}) to ({x1}, {y1}), its holes left out"
            yield UnplacedFault(path, problem, f"move it: {remedy}")
