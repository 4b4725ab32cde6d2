"""What types can't say of a mission in space: all of it, on whatever parts are sound."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator

from viaspline.mission.partial_mission import PartialMission
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.same_places import PointPlace, same_place_faults
from viaspline.mission.shapes.solids import Place
from viaspline.mission.space.altitude_checks import altitude_faults
from viaspline.mission.space.flight_places import ground_height, place_of, standing_height
from viaspline.mission.space.flown_place import FlownPlace
from viaspline.mission.space.gate_checks import facing_faults, narrow_faults
from viaspline.mission.space.place_checks import PlaceChecks, point_label
from viaspline.mission.space.planar_keys import planar_key_faults
from viaspline.mission.space.point_heights import START, point_height_faults
from viaspline.mission.space.spatial_parts import SpatialParts
from viaspline.mission.unplaced_faults import Path, UnplacedFault, number


def spatial_faults(
    partial: PartialMission, space: SpatialParts, misshapen: Collection[Path]
) -> list[UnplacedFault]:
    """Everything that is wrong with a mission in space, beside what may be with any mission.

    Args:
        partial: The parts of the mission that are sound.
        space: Those that there are in space only.
        misshapen: Paths of obstacles and fences that have no usable shape.
    """
    faults = [*planar_key_faults(space.planar_keys), *altitude_faults(space)]
    faults += point_height_faults(partial, space)
    faults += _low_takeoff(partial, space)
    told = {fault.path for fault in faults}
    checks = PlaceChecks.of(partial, space, misshapen, _home(partial, space))
    for visit in _visits(partial, space):
        if visit.path not in told and visit.plan_path not in told:
            found = list(checks.faults(visit))
            told.update(fault.path for fault in found)
            faults += found
    stops = list(_stops(partial, space))
    closed = bool(partial.closed) and not partial.has_goal
    faults += same_place_faults(stops, in_given_order=partial.in_given_order, closed=closed)
    return [*faults, *_gates(partial, space, stops)]


def _home(partial: PartialMission, space: SpatialParts) -> float:
    """How high the ground is under the start [m]; NaN if nobody knows."""
    start = partial.points[0][1] if partial.points else None
    if start is None or (space.has_ground and space.ground is None):
        return math.nan
    return ground_height(space.ground, *start.at[:2])


def _standing(partial: PartialMission) -> float:
    return standing_height(partial.robot or RobotSpec(radius_m=0, clearance_m=0))


def _visits(partial: PartialMission, space: SpatialParts) -> Iterator[FlownPlace]:
    """Every place at which the robot has to be able to be."""
    home = _home(partial, space)
    for path, point in partial.points:
        if point is None:
            continue
        plan_path = (*path, "gate", "at") if point.gate is not None else (*path, "at")
        where = plan_path if point.agl_m is None else (*path, "agl_m")
        x, y, z = place_of(point, space.ground)
        if path == START and space.has_takeoff:
            yield from _takeoff((x, y, z), plan_path, home, partial, space)
        elif not math.isnan(z):
            yield FlownPlace(point_label(path, point), (x, y, z), where, plan_path)
    if space.land is not None:
        x, y = space.land.at
        z = ground_height(space.ground, x, y) + _standing(partial)
        if not math.isnan(z):
            path = ("route", "land", "at")
            yield FlownPlace("the landing", (x, y, z), path, path, on_ground=True)
            yield from _descent((x, y, z), path, home, partial, space)


def _takeoff(
    start: Place, plan_path: Path, home: float, partial: PartialMission, space: SpatialParts
) -> Iterator[FlownPlace]:
    """The climb, and where it ends."""
    if space.takeoff is None or math.isnan(home):
        return
    x, y, z = start
    z = home + _standing(partial) if math.isnan(z) else z
    top, path = home + space.takeoff.to_agl_m, ("route", "takeoff", "to_agl_m")
    yield FlownPlace("the end of take-off", (x, y, top), path, plan_path)
    # What is wrong with its end is wrong with the climb as well, and told once.
    yield FlownPlace("the climb of take-off", (x, y, z), path[:2], path, on_ground=True, top=top)


def _descent(
    landing: Place, path: Path, home: float, partial: PartialMission, space: SpatialParts
) -> Iterator[FlownPlace]:
    """The way down from as high as the last via point, where it is known which that is."""
    point = partial.points[-1][1] if partial.points else None
    if point is None or not (partial.in_given_order or len(partial.points) == 1):
        return
    top = place_of(point, space.ground)[2]
    if len(partial.points) == 1 and space.takeoff is not None:
        top = home + space.takeoff.to_agl_m
    if top > landing[2]:  # which it isn't if its height isn't known
        label = "the descent to the landing"
        yield FlownPlace(label, landing, path[:2], path, on_ground=True, top=top)


def _low_takeoff(partial: PartialMission, space: SpatialParts) -> Iterator[UnplacedFault]:
    """A take-off that ends no higher than it begins."""
    home = _home(partial, space)
    start = partial.points[0][1] if partial.points else None
    if space.takeoff is None or start is None or math.isnan(home):
        return
    z = place_of(start, space.ground)[2]
    z = home + _standing(partial) if math.isnan(z) else z
    if home + space.takeoff.to_agl_m <= z:
        problem = f"take-off ends {number(space.takeoff.to_agl_m)} m above ground, no higher than "
        least = number(math.floor(z - home) + 1.0)
        path: Path = ("route", "takeoff", "to_agl_m")
        yield UnplacedFault(path, f"{problem}it begins", f"give {least} or more")


def _stops(partial: PartialMission, space: SpatialParts) -> Iterator[PointPlace]:
    """The places of the route in order, those left out whose height isn't known."""
    for i, (path, point) in enumerate(partial.points):
        if point is None:
            continue
        x, y, z = place_of(point, space.ground)
        if path == START and space.has_takeoff:
            if space.takeoff is not None:
                z = _home(partial, space) + space.takeoff.to_agl_m
            path = ("route", "takeoff")
        if not math.isnan(z):
            yield PointPlace(path, (x, y, z), i)


def _gates(
    partial: PartialMission, space: SpatialParts, stops: list[PointPlace]
) -> Iterator[UnplacedFault]:
    """Gates that are too narrow, or are passed backwards wherever the order puts them."""
    places = {stop.rank: stop.place for stop in stops}
    end: list[tuple[float, ...]] = [] if space.land is None else [space.land.at]
    if partial.closed:
        end = [places[rank] for rank in (0,) if rank in places]
    for rank, (path, point) in enumerate(partial.points):
        if point is None or point.gate is None or rank not in places:
            continue
        if partial.robot is not None:
            yield from narrow_faults(path, point.gate, partial.robot)
        before, behind = _beside(partial, rank)
        if places.keys() >= {*before, *behind}:
            ends = [] if partial.in_given_order and behind else end
            follow = [*(places[k] for k in behind), *ends]
            yield from facing_faults(path, point.gate, [places[k] for k in before], follow)


def _beside(partial: PartialMission, rank: int) -> tuple[list[int], list[int]]:
    """The points that may come right before one, and right after it."""
    count = len(partial.points)
    if partial.in_given_order:
        return list(range(max(rank - 1, 0), rank)), list(range(rank + 1, min(rank + 2, count)))
    vias = range(1, count - int(partial.has_goal))
    goal = [count - 1] if partial.has_goal else []
    others = [k for k in vias if k != rank]
    return [0, *others], [*others, *goal]
