"""Can the robot stand at every point of the route, and where is the nearest place if not?

Tested through ``mission/test_model``.
"""

from __future__ import annotations

import math
from collections.abc import Collection
from typing import NamedTuple

from viaspline.errors import Change
from viaspline.maps.squares import is_unknown
from viaspline.mission.corridors import CORRIDOR_PATH, corridor_of
from viaspline.mission.fields import Corners
from viaspline.mission.freespace import FreeSpace
from viaspline.mission.partial_mission import PartialMission, obstacle_label
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.route_spec import ViaPoint
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.unplaced_faults import Path, UnplacedFault, number, spell

ROUND_OFF_M = 1e-9
"""A point may be this much too near [m]: round-off, not a fault."""


def clearance_faults(partial: PartialMission, misshapen: Collection[Path]) -> list[UnplacedFault]:
    """Points of the route too near to an obstacle, to the bounds or to a fence.

    Args:
        partial: The parts of the mission that are sound.
        misshapen: Paths of obstacles and fences that have no usable shape.
    """
    points = [(path, point) for path, point in partial.points if point is not None]
    robot, about = partial.robot_or_point, partial.standing(misshapen)
    rings: list[tuple[Path, tuple[Corners, ...]]] = [(path, (ring,)) for path, ring in about.fences]
    rings += corridor_of(partial)
    known = about.known
    if not points or not (known or rings or about.bounds):
        return []
    margin = robot.inner_radius + robot.clearance_m
    space = FreeSpace(
        about.bounds, [area for _, area in rings], [item for _, item in known], margin
    )
    return [
        UnplacedFault(
            (*points[i][0], "at"), _problem(points[i], near, margin), remedy, changes=changes
        )
        for i, nears in _too_near(
            space, points, known, [path for path, _ in rings], partial.edge
        ).items()
        for remedy, changes in [_remedy(points[i], nears, robot, space, partial.robot_path)]
        for near in nears
    ]


class _Near(NamedTuple):
    """Something that a point is too near to.

    Attributes:
        thing: What it is called.
        distance: The signed distance [m].
        wrong_side: Where a point with a negative distance lies.
        is_unknown: Whether the point is there because nothing is known of the place.
    """

    thing: str
    distance: float
    wrong_side: str
    is_unknown: bool = False


def _too_near(
    space: FreeSpace,
    points: list[tuple[Path, ViaPoint]],
    known: list[tuple[Path, Obstacle]],
    fences: list[Path],
    edge: Collection[Path],
) -> dict[int, list[_Near]]:
    """For each point in trouble, what it is too near to."""
    places = [point.at[:2] for _, point in points]
    found: dict[int, list[_Near]] = {}

    def note(i: int, near: _Near) -> None:
        if near.distance < space.margin - ROUND_OFF_M:
            found.setdefault(i, []).append(near)

    for i, distance in space.near_bounds(places):
        note(i, _Near(_edge_label(("world", "bounds"), edge, "the bounds"), distance, "outside"))
    for i, j, distance in space.near_fences(places):
        path = fences[j]
        label = "the corridor" if path == CORRIDOR_PATH else f"fence {spell(path)}"
        note(i, _Near(_edge_label(path, edge, label), distance, "outside"))
    for i, j, distance in space.near_obstacles(places):
        path, obstacle = known[j]
        unknown = obstacle.grid is not None and is_unknown(obstacle.grid, places[i])
        note(i, _Near(obstacle_label(path, obstacle), distance, "inside", unknown))
    return found


def _edge_label(path: Path, edge: Collection[Path], label: str) -> str:
    """Bounds and fences that nobody gave are the map's."""
    return "the edge of the map" if path in edge else label


def _problem(where: tuple[Path, ViaPoint], near: _Near, margin: float) -> str:
    name = _label(*where)
    if near.is_unknown:
        return f"{name} lies in unknown space of {near.thing}"
    if near.distance < 0:
        return f"{name} lies {_metres(-near.distance)} {near.wrong_side} {near.thing}"
    return f"{name} lies {_metres(margin - near.distance)} inside the clearance of {near.thing}"


def _metres(length: float) -> str:
    return f"{number(length)} m" if length >= 5e-4 else "less than 1 mm"


def _remedy(
    where: tuple[Path, ViaPoint],
    nears: list[_Near],
    robot: RobotSpec,
    space: FreeSpace,
    robot_path: Path,
) -> tuple[str, tuple[Change, ...]]:
    path, point = where
    remedies = []
    changes = []
    place = space.nearest(point.at[:2])
    if place is not None:
        remedies.append(f"move it to ({', '.join(number(x, 6) for x in place)})")
        changes.append(Change(spell((*path, "at")), (*place, *point.at[2:])))
    if all(near.is_unknown for near in nears):
        remedies.append("set unknown: free for the map")
    tightest = min(near.distance for near in nears)
    # Rounded down, so that what is said is enough.
    clearance = math.floor((tightest - robot.inner_radius - 1e-6) * 1e3) / 1e3
    if clearance >= 0:
        key = spell((*robot_path, "clearance_m"))
        remedies.append(f"set {key} to at most {number(clearance)}")
        changes.append(Change(key, clearance))
    if not remedies:
        return "there is no room for the robot near it: move it, or make the robot smaller", ()
    return " or ".join(remedies), tuple(changes)


def _label(path: Path, point: ViaPoint) -> str:
    kind = next(part for part in reversed(path) if isinstance(part, str))
    if point.name is not None:
        return f"{kind} '{point.name}'"
    return "the via point" if kind == "via" else kind
