"""From an itinerary in degrees to a mission in metres.

Tested through ``formats/test_qgc_plan``.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, Final

import numpy as np

from viaspline.caller_warning import warn_caller
from viaspline.errors import Fault, MissionError, with_article
from viaspline.formats.fences import fence_areas
from viaspline.formats.file_faults import fault_at, refusal
from viaspline.formats.first_speed import speed_of
from viaspline.formats.flights import ground_of, not_flown, route_in_space
from viaspline.formats.items import FenceArea, Itinerary, LatLon, Place
from viaspline.formats.known_heights import check_known_heights
from viaspline.formats.legs import Stop, stops_of
from viaspline.formats.local_frame import MAX_REACH_M, LocalFrame
from viaspline.kernels.arrays import Floats
from viaspline.mission.model import Mission

SAME_STOP_M: Final = 0.02
"""Stops nearer than this are one: the files resolve 1e-7 degree, about a centimetre."""

_ROUTE_KEY: Final = re.compile(r"route\.(start|goal|takeoff|land|via\[(\d+)\])")
_WORLD_KEY: Final = re.compile(r"world\.(known|fences)\[(\d+)\]")


def mission_of(itinerary: Itinerary) -> Mission:
    """The mission of an itinerary.

    The frame's origin and the start are the home position, or the first item with a position if
    there is no plausible one; a plan that viaspline wrote has an origin of its own. Heights are
    kept as they are given. Climbs and descents on the spot become one point at the height of the
    way. With a ground it is a mission in space, in which take-off, landing, climbs and what is
    looked at are flown, and altitudes above terrain are heights above ground.

    Raises:
        MissionError: Nothing can be driven, or the mission is not sound.

    Warns:
        MissionWarning: One for each kind of thing that a mission can't represent.
    """
    stops, notes = stops_of(itinerary)
    areas, loose = fence_areas(itinerary)
    if not stops:
        _warn(itinerary.source, (*itinerary.notes, *notes, *loose))
        place = Place("mission")
        problem = "no item has a position to go to" + _aside(itinerary.notes)
        raise refusal(itinerary.source, place, problem, "give two way points or more")
    frame = _frame(itinerary, stops)
    _check_coordinates(frame, itinerary.source, stops, areas)
    if itinerary.ground is not None:
        _warn(itinerary.source, (*itinerary.notes, *not_flown(notes), *loose))
        return _in_space(itinerary, frame, stops, areas)
    stops, climbs = _merged(stops, _local(frame, stops))
    unknown = () if itinerary.is_flat else _without_height(stops)
    _warn(itinerary.source, (*itinerary.notes, *notes, *loose, *climbs, *unknown))
    if len(stops) < 2:
        problem = "all items are at one place: a way needs two distinct points"
        problem += _aside(itinerary.notes)
        raise refusal(itinerary.source, stops[0].place, problem, "give another way point")
    route = _route(stops, _local(frame, stops), is_flat=itinerary.is_flat)
    return _mission(itinerary, frame, route, stops, areas)


def _in_space(
    itinerary: Itinerary, frame: LocalFrame, stops: Sequence[Stop], areas: Sequence[FenceArea]
) -> Mission:
    """The mission of a way over a ground that is known."""
    ground = ground_of(itinerary)
    check_known_heights(itinerary.source, stops, frame, ground)
    flown = route_in_space(stops, frame, ground)
    _warn(itinerary.source, flown.notes)
    return _mission(itinerary, frame, flown.route, flown.stops, areas, {"ground": ground})


def _mission(
    itinerary: Itinerary,
    frame: LocalFrame,
    route: Mapping[str, Any],
    stops: Sequence[Stop],
    areas: Sequence[FenceArea],
    more: Mapping[str, Any] | None = None,
) -> Mission:
    """The mission of a route.

    Args:
        itinerary: The whole file.
        frame: Where its 0, 0 is.
        route: The route.
        stops: Where its points stand in the file: start, via points, and the goal if there is one.
        areas: All fences.
        more: What else its world has.
    """
    fences = [area for area in areas if area.inclusion]
    obstacles = [area for area in areas if not area.inclusion]
    speed = speed_of(itinerary)
    data = {
        "world": {
            "fences": [_ring(frame, area) for area in fences],
            "known": [_obstacle(frame, area, i) for i, area in enumerate(obstacles, start=1)],
            **(more or {}),
            "origin_deg": frame.geographic,
        },
        "robot": {} if speed is None else {"max_speed_mps": speed},
        "route": route,
    }
    try:
        return Mission.model_validate(data)
    except MissionError as error:
        places = (stops, tuple(fences), tuple(obstacles))
        raise MissionError(
            [_in_file(itinerary, fault, *places) for fault in error.faults]
        ) from None


def origin_in(itinerary: Itinerary) -> LatLon | None:
    """Where the mission's 0, 0 is [deg]; None if nothing has a position."""
    stops, _ = stops_of(itinerary)
    if not stops:
        return None
    return _frame(itinerary, stops).geographic


def _frame(itinerary: Itinerary, stops: Sequence[Stop]) -> LocalFrame:
    return LocalFrame(*(itinerary.origin or (stops[0].latitude, stops[0].longitude)))


def _warn(source: str, notes: Sequence[tuple[str, str]]) -> None:
    for kind, where in notes:
        message = f"{source}: {where}: {kind}" if where else f"{source}: {kind}"
        warn_caller(f"{message} (can't be represented in a mission)")


def _aside(notes: Sequence[tuple[str, str]]) -> str:
    """What else is in the file, where too little of it is left."""
    return "".join(f" ({where} is {with_article(kind)})" for kind, where in notes)


def _check_coordinates(
    frame: LocalFrame, source: str, stops: Sequence[Stop], areas: Sequence[FenceArea]
) -> None:
    """Refuse what is not on the globe, or too far from the origin for a flat frame."""
    named = [(stop.latitude, stop.longitude, stop.place) for stop in stops]
    for area in areas:
        corners = area.corners if area.center is None else (area.center,)
        named += [(latitude, longitude, area.place) for latitude, longitude in corners]
    faults = []
    for latitude, longitude, place in named:
        if not (abs(latitude) <= 90 and abs(longitude) <= 360):
            problem = f"{latitude:g}, {longitude:g} isn't a latitude and a longitude"
            remedy = "latitudes are -90 to 90, longitudes -180 to 180 degrees"
            faults.append(fault_at(source, place, problem, remedy))
        # The plane folds back on the far side of the globe: ask the angle, not the metres.
        elif abs(frame.latitude) <= 90 and frame.arc(latitude, longitude) > MAX_REACH_M:
            problem = f"is more than {MAX_REACH_M / 1e3:g} km away from the start"
            remedy = "a mission has one flat frame: split it, or correct the home position"
            faults.append(fault_at(source, place, problem, remedy))
    if faults:
        raise MissionError(list(dict.fromkeys(faults)))


def _local(frame: LocalFrame, stops: Sequence[Stop]) -> Floats:
    """The stops in metres, shape (n, 2)."""
    return frame.to_local([s.latitude for s in stops], [s.longitude for s in stops])


def _merged(
    stops: Sequence[Stop], local: Floats
) -> tuple[tuple[Stop, ...], tuple[tuple[str, str], ...]]:
    """Stops at one place as one, with the sum of their dwells and the height of the way."""
    merged = [stops[0]]
    corner = local[0]
    climbs: list[str] = []
    for stop, xy in zip(stops[1:], local[1:], strict=True):
        last = merged[-1]
        if np.hypot(*(xy - corner)) >= SAME_STOP_M:
            merged.append(stop)
            corner = xy
            continue
        # A climb comes before the way that it leads to, a landing after the way that leads to it.
        keeps = stop.is_landing or math.isnan(stop.height)
        height = last.height if keeps else stop.height
        if abs(stop.height - last.height) > 1e-6:
            climbs.append(stop.place.key)
        merged[-1] = replace(last, height=height, dwell=last.dwell + stop.dwell)
    notes = (("climb or descent on the spot", ", ".join(climbs)),) if climbs else ()
    return tuple(merged), notes


def _without_height(stops: Sequence[Stop]) -> tuple[tuple[str, str], ...]:
    """That heights are left out because some stops say none of any kind."""
    lacking = [
        stop.place.key
        for stop in stops
        if math.isnan(stop.height) and math.isnan(stop.over_terrain)
    ]
    if not lacking or len(lacking) == len(stops):
        return ()
    return (("no altitude, or none that is a number: heights are left out", ", ".join(lacking)),)


def _route(stops: Sequence[Stop], local: Floats, *, is_flat: bool) -> dict[str, Any]:
    is_3d = not is_flat and all(math.isfinite(stop.height) for stop in stops)
    points: list[dict[str, Any]] = []
    for stop, (x, y) in zip(stops, local.tolist(), strict=True):
        # Adding zero turns -0.0 into 0.0: one place, one spelling.
        at = [x + 0.0, y + 0.0, stop.height + 0.0] if is_3d else [x + 0.0, y + 0.0]
        points.append({"at": at, "dwell_s": stop.dwell} if stop.dwell else {"at": at})
    return {"start": points[0], "via": points[1:-1], "goal": points[-1]}


def _ring(frame: LocalFrame, area: FenceArea) -> list[list[float]]:
    """The polygon of a fence; a circle becomes the polygon inside of it."""
    if area.center is None:
        latitudes, longitudes = zip(*area.corners, strict=True)
        corners: list[list[float]] = frame.to_local(latitudes, longitudes).tolist()
        return corners
    angles = np.linspace(0, 2 * np.pi, 64, endpoint=False)
    center = frame.to_local(*area.center)
    ring = center + area.radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    inscribed: list[list[float]] = ring.tolist()
    return inscribed


def _obstacle(frame: LocalFrame, area: FenceArea, number: int) -> dict[str, Any]:
    name = f"exclusion {number}"
    if area.center is None:
        return {"name": name, "polygon": _ring(frame, area)}
    center = frame.to_local(*area.center).tolist()
    return {"name": name, "circle": {"center": center, "radius": area.radius}}


def _in_file(
    itinerary: Itinerary,
    fault: Fault,
    stops: Sequence[Stop],
    fences: Sequence[FenceArea],
    obstacles: Sequence[FenceArea],
) -> Fault:
    """A fault of the mission as a fault of the file that it came from."""
    place = Place(fault.key)
    if found := _ROUTE_KEY.match(fault.key):
        index = {"start": 0, "takeoff": 0}.get(found[1])
        index = len(stops) - 1 if found[1] in ("goal", "land") else index
        place = stops[int(found[2]) + 1 if index is None else index].place
    elif found := _WORLD_KEY.match(fault.key):
        place = (obstacles if found[1] == "known" else fences)[int(found[2])].place
    problem = f"({fault.key}) {fault.problem}"
    return fault_at(itinerary.source, place, problem, fault.remedy)
