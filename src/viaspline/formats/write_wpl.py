"""Missions to ``QGC WPL 110`` files: one item a line, twelve fields, item 0 is home."""

from __future__ import annotations

from collections.abc import Iterator

from viaspline.formats.commands import EXCLUSION_CIRCLE, EXCLUSION_CORNER, INCLUSION_CORNER
from viaspline.formats.items import FenceArea, Item, Itinerary, LatLon
from viaspline.formats.outgoing import WAYPOINT, Written, itinerary_of, lost_of
from viaspline.mission.model import Mission
from viaspline.mission.robot_parts import RobotSpec


def wpl_text(mission: Mission, origin: LatLon | None) -> Written:
    """A mission as a ``QGC WPL 110`` text.

    Start, via points and goal are way points with their dwells as hold times; obstacles, fences
    and bounds are fence items behind them. Home is the start, so reading the text gives a mission
    with its 0, 0 there; every point has a height, 0 if the mission is flat.

    Args:
        mission: The mission.
        origin: Latitude and longitude of its 0, 0 [deg]; `viaspline.formats.load.origin_of` tells
            that of a file.

    Raises:
        OutputError: There is no origin, or the mission reaches too far from it.

    >>> mission = Mission.model_validate({"route": {"start": [0, 0], "goal": [90, 0]}})
    >>> print(wpl_text(mission, (47.0, 8.0)).text.splitlines()[-1].replace(chr(9), " "))
    2 0 3 16 0 0 0 0 46.9999999939 8.0011833386 0 1
    """
    itinerary = itinerary_of(mission, origin)
    more: list[tuple[str, str]] = []
    if mission.robot.max_speed_mps != RobotSpec().max_speed_mps:
        more.append(("robot", "max_speed_mps"))
    if any(mission.route.start.at[:2]):
        more.append(("place of the origin: read again, 0, 0 is at the start", "route.start"))
    text = "\n".join(("QGC WPL 110", *_lines(itinerary)))
    return Written(text + "\n", lost_of(itinerary, *more))


def _lines(itinerary: Itinerary) -> Iterator[str]:
    home = itinerary.home
    assert home is not None
    # Above sea level, by which item 0 is known to be home.
    yield _line(0, 0, WAYPOINT, (0.0,) * 4, (home.latitude, home.longitude), home.altitude)
    for item in itinerary.items:
        yield _of_item(item)
    number = len(itinerary.items) + 1
    for area in itinerary.fences:
        for line in _of_fence(number, area):
            yield line
            number += 1


def _of_item(item: Item) -> str:
    params = (item.params[0], 0.0, 0.0, 0.0)
    place = (item.latitude, item.longitude)
    return _line(item.number, item.frame, item.command, params, place, item.altitude)


def _of_fence(number: int, area: FenceArea) -> Iterator[str]:
    if area.center is not None:
        yield _line(number, 0, EXCLUSION_CIRCLE, (area.radius, 0.0, 0.0, 0.0), area.center, 0.0)
        return
    command = INCLUSION_CORNER if area.inclusion else EXCLUSION_CORNER
    params = (float(len(area.corners)), 0.0, 0.0, 0.0)
    for i, corner in enumerate(area.corners):
        yield _line(number + i, 0, command, params, corner, 0.0)


def _line(
    number: int, frame: int, command: int, params: tuple[float, ...], place: LatLon, height: float
) -> str:
    fields = [
        str(number),
        "1" if number == 0 else "0",
        str(frame),
        str(command),
        *map(_number, params),
        *(f"{degrees:.10f}" for degrees in place),
        _number(height),
        "1",
    ]
    return "\t".join(fields)


def _number(value: float) -> str:
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)
