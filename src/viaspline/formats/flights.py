"""From stops to a route in space: take-off, heights over whatever they count from, landing."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path as FilePath
from typing import Any, Final, NamedTuple, TypeAlias

from pydantic import TypeAdapter, ValidationError

from viaspline.errors import MissionError
from viaspline.formats.file_faults import refusal
from viaspline.formats.items import ABSOLUTE, Item, Itinerary, Place
from viaspline.formats.legs import NO_HOME_ALTITUDE, OVER_SEA, OVER_TERRAIN, Stop
from viaspline.formats.local_frame import LocalFrame
from viaspline.mission.space.flight_places import ground_height
from viaspline.mission.space.ground_spec import GroundSpec
from viaspline.mission.space.read_solids import read_ground

SAME_PLACE_M: Final = 0.02
"""Places nearer than this are one: the files resolve 1e-7 degree, about a centimetre."""

_FLOWN: Final = frozenset(
    {OVER_TERRAIN, OVER_SEA, NO_HOME_ALTITUDE, "region of interest", "end of region of interest"}
)

ON_THE_GROUND: Final = "delay before it flies: left out"

SECOND_LOOK: Final = "looks elsewhere from the same place: left out"


_Placed: TypeAlias = tuple[Stop, tuple[float, float]]
"""A stop and its place in the plane [m]."""


class FlownRoute(NamedTuple):
    """A route in space.

    Attributes:
        route: As a mission has it.
        stops: Where its points stand in the file: start, via points, and the goal or the landing.
        notes: What of the stops a route can't have, by kind: where.
    """

    route: dict[str, Any]
    stops: tuple[Stop, ...]
    notes: tuple[tuple[str, str], ...]


def not_flown(notes: Sequence[tuple[str, str]]) -> tuple[tuple[str, str], ...]:
    """What of an itinerary a mission in space can't represent either.

    >>> not_flown([("region of interest", "item 3"), ("photograph", "item 4")])
    (('photograph', 'item 4'),)
    """
    return tuple(note for note in notes if note[0] not in _FLOWN)


def ground_of(itinerary: Itinerary) -> GroundSpec:
    """The ground of an itinerary that has one, its terrain read.

    Raises:
        MissionError: It is no ground, or its file can't be read.
    """
    if isinstance(itinerary.ground, GroundSpec):
        return itinerary.ground
    read = read_ground({"world": {"ground": itinerary.ground}}, FilePath())
    place = Place("ground")
    if read.faults:
        fault = read.faults[0]
        raise refusal(itinerary.source, place, fault.problem, fault.remedy)
    try:
        found: GroundSpec = TypeAdapter(GroundSpec).validate_python(read.data["world"]["ground"])
    except ValidationError as error:
        raise _no_ground(itinerary, place, error) from None
    return found


def _no_ground(itinerary: Itinerary, place: Place, error: ValidationError) -> MissionError:
    from viaspline.mission.schema_errors import schema_faults

    fault = schema_faults(error, ("world", "ground"))[0]
    return refusal(itinerary.source, place, fault.problem, fault.remedy)


def route_in_space(stops: Sequence[Stop], frame: LocalFrame, ground: GroundSpec) -> FlownRoute:
    """The route of some stops, of which the first is where heights are above.

    Where the first item takes off from there, the route begins on the ground; else it begins in the
    air at the first place to go to. Where the last one lands, the route ends on the ground.

    Args:
        stops: The stops in order.
        frame: Where the mission's 0, 0 is.
        ground: The ground.
    """
    local = frame.to_local([s.latitude for s in stops], [s.longitude for s in stops]).tolist()
    places = [(x + 0.0, y + 0.0) for x, y in local]
    home = ground_height(ground, *places[0])
    left = list(zip(stops, places, strict=True))
    notes = [(ON_THE_GROUND, stops[0].place.key)] if stops[0].is_home and stops[0].dwell else []
    route: dict[str, Any] = {}
    above: list[_Placed] = []
    if len(left) > 1 and left[1][0].is_takeoff and math.dist(places[0], places[1]) < SAME_PLACE_M:
        above = [left.pop(1)]
        behind = left[1:]
    else:
        behind = left[1:] if left[0][0].is_home else left
    landing = behind.pop() if behind and behind[-1][0].is_landing else None
    kept, repeats = _without_repeats([*above, *behind], home, ground)
    top, behind = kept[: len(above)], kept[len(above) :]
    points = [_point(stop, at, home, frame, ground) for stop, at in behind]
    told = [stop for stop, _ in behind]
    for stop, at in top:
        route["takeoff"] = {"to_agl_m": _above_ground(stop, home)}
        # It stays, and looks at something, where its climb ends.
        start = {**_point(stop, at, home, frame, ground), "at": places[0]}
        start.pop("agl_m", None)
        points = [start, *points]
        told = [stops[0], *told]
    if landing is not None:
        route["land"] = {"at": landing[1]}
        told = [*told, landing[0]]
    elif len(points) > 1:
        route["goal"] = points.pop()
    route |= {"start": points[0] if points else {"at": places[0]}, "via": points[1:]}
    return FlownRoute(route, tuple(told), (*notes, *repeats))


def _without_repeats(
    placed: Sequence[_Placed], home: float, ground: GroundSpec
) -> tuple[list[_Placed], list[tuple[str, str]]]:
    """Stops in a row at one place in the air as one, which stays as long as all of them.

    It looks where the first one of them does; that others look elsewhere is noted.
    """
    kept: list[_Placed] = []
    elsewhere: list[str] = []
    last = (math.nan, math.nan, math.nan)
    for stop, at in placed:
        here = (*at, _altitude(stop, at, home, ground))
        if not math.dist(here, last) < SAME_PLACE_M:
            kept.append((stop, at))
            last = here
            continue
        before, where = kept[-1]
        look_at = before.look_at if before.look_at is not None else stop.look_at
        if stop.look_at is not None and stop.look_at != look_at:
            elsewhere.append(stop.place.key)
        kept[-1] = (replace(before, dwell=before.dwell + stop.dwell, look_at=look_at), where)
    return kept, [(SECOND_LOOK, ", ".join(elsewhere))] if elsewhere else []


def _altitude(stop: Stop, at: tuple[float, float], home: float, ground: GroundSpec) -> float:
    """Where a stop is above the sea [m]."""
    if math.isfinite(stop.over_terrain):
        return ground_height(ground, *at) + stop.over_terrain
    return stop.altitude if math.isfinite(stop.altitude) else home + stop.height


def _above_ground(stop: Stop, home: float) -> float:
    """How high above the ground at home a stop is there [m]."""
    if math.isfinite(stop.over_terrain):
        return stop.over_terrain
    return stop.altitude - home if math.isfinite(stop.altitude) else stop.height


def _point(
    stop: Stop, at: tuple[float, float], home: float, frame: LocalFrame, ground: GroundSpec
) -> dict[str, Any]:
    """A stop as a point of a route."""
    point: dict[str, Any] = {"at": [*at]}
    if math.isfinite(stop.over_terrain):
        point["agl_m"] = stop.over_terrain
    else:
        point["at"] = [*at, _altitude(stop, at, home, ground)]
    if stop.dwell:
        point["dwell_s"] = stop.dwell
    if stop.look_at is not None:
        point["look_at"] = _looked_at(stop.look_at, home, frame, ground)
    return point


def _looked_at(item: Item, home: float, frame: LocalFrame, ground: GroundSpec) -> list[float]:
    x, y = frame.to_local(item.latitude, item.longitude).tolist()
    if math.isfinite(item.over_terrain):
        return [x, y, ground_height(ground, x, y) + item.over_terrain]
    return [x, y, item.altitude if item.frame in ABSOLUTE else home + item.altitude]
