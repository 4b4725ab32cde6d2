"""Heights that count from a ground which nobody knows: refused, going out and coming in."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from viaspline.errors import Fault, MissionError, OutputError
from viaspline.formats.file_faults import fault_at
from viaspline.formats.items import ABSOLUTE, Place
from viaspline.formats.legs import Stop
from viaspline.formats.local_frame import LocalFrame
from viaspline.mission.space.flight_places import ground_height
from viaspline.mission.space.ground_spec import GroundSpec


def check_known_home(home: float) -> None:
    """Refuse to write heights above a home whose ground nobody knows.

    Args:
        home: How high the ground is under the start [m]; NaN if nobody knows.

    Raises:
        OutputError: It isn't known.
    """
    if math.isnan(home):
        problem = "the file's heights count from home, on the ground under the start"
        remedy = "begin over known ground, or write a format with heights above sea level, as .kml"
        where = "nobody knows how high that is there: it is beyond the terrain, or in a hole of it"
        raise OutputError("<mission>", f"{problem}, but {where}; {remedy}")


def check_known_heights(
    source: str, stops: Sequence[Stop], frame: LocalFrame, ground: GroundSpec
) -> None:
    """Refuse stops that nobody can tell the height of.

    Args:
        source: The file.
        stops: In order; the first is where heights are above.
        frame: Where the mission's 0, 0 is.
        ground: The ground.

    Raises:
        MissionError: All that is wrong with them.
    """
    faults = list(dict.fromkeys(_faults(source, stops, frame, ground)))
    if faults:
        raise MissionError(faults)


def _faults(
    source: str, stops: Sequence[Stop], frame: LocalFrame, ground: GroundSpec
) -> Iterator[Fault]:
    is_unknown = math.isnan(_ground_at(stops[0].latitude, stops[0].longitude, frame, ground))
    for stop in stops:
        if not (stop.is_home or stop.is_landing or math.isfinite(stop.over_terrain)):
            if not math.isfinite(stop.height):
                yield _no_altitude(source, stop.place)
            elif is_unknown and (stop.is_takeoff or not math.isfinite(stop.altitude)):
                yield _unknown_home(source, stops[0], ground)
        item = stop.look_at
        if item is None:
            continue
        if math.isfinite(item.over_terrain):
            if math.isnan(_ground_at(item.latitude, item.longitude, frame, ground)):
                problem = "nobody knows how high the ground is here, above which it looks"
                remedy = "give an altitude above sea level, or a terrain that reaches there"
                yield fault_at(source, item.place, problem, remedy)
        elif not math.isfinite(item.altitude):
            yield _no_altitude(source, item.place)
        elif is_unknown and item.frame not in ABSOLUTE:
            yield _unknown_home(source, stops[0], ground)


def _ground_at(latitude: float, longitude: float, frame: LocalFrame, ground: GroundSpec) -> float:
    x, y = frame.to_local(latitude, longitude).tolist()
    return ground_height(ground, x, y)


def _no_altitude(source: str, place: Place) -> Fault:
    problem = "has no altitude, or none that is a number"
    return fault_at(source, place, problem, "give one, above home, terrain or sea level")


def _unknown_home(source: str, home: Stop, ground: GroundSpec) -> Fault:
    problem = "heights count from here, but nobody knows how high the ground is here"
    remedy = "correct the home position, or give altitudes above sea level or terrain"
    if ground.terrain is not None:
        x0, y0, x1, y1 = ground.terrain.extent
        reach = f"the terrain reaches from ({x0:.1f}, {y0:.1f}) to ({x1:.1f}, {y1:.1f}) m"
        remedy += f": {reach}, its holes left out"
    return fault_at(source, home.place, problem, remedy)
