"""``QGC WPL`` files: mission items as a table of text, one item a line, twelve fields.

Fields: number, current, frame, command, parameters 1 to 4, latitude, longitude, altitude,
autocontinue. By custom item 0 is the home position.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import ClassVar, Final

from viaspline.errors import Fault, MissionError
from viaspline.formats.commands import EXCLUSION_CIRCLE, EXCLUSION_CORNER, INCLUSION_CORNER
from viaspline.formats.file_faults import fault_at, refusal
from viaspline.formats.flown_items import WAYPOINT
from viaspline.formats.items import (
    ABSOLUTE,
    TERRAIN,
    FenceArea,
    Home,
    Item,
    Itinerary,
    LatLon,
    Place,
)
from viaspline.formats.mission_format import Whereabouts, Written
from viaspline.formats.outgoing import itinerary_of, lost_of
from viaspline.formats.waypoint_format import WaypointFormat
from viaspline.mission.model import Mission
from viaspline.mission.robot_parts import RobotSpec

_HEADER: Final = re.compile(r"QGC\s+WPL\s+(\S+)")
_VERSIONS: Final = ("110", "120")
_FIELD: Final = re.compile(r"\S+")
_COLUMNS: Final = (
    "number", "current", "frame", "command", "param1", "param2", "param3", "param4",
    "latitude", "longitude", "altitude", "autocontinue",
)  # fmt: skip
_WHOLE_NUMBERS: Final = frozenset({"number", "current", "frame", "command", "autocontinue"})


class QgcWpl(WaypointFormat):
    """Tables of way points, as ground stations for ArduPilot save them."""

    description: ClassVar[str] = "texts that begin with QGC WPL 110 (.txt, .waypoints, .mission)"
    endings: ClassVar[tuple[str, ...]] = (".waypoints", ".txt", ".mission")
    saved_endings: ClassVar[tuple[str, ...]] = (".waypoints", ".txt")

    def sniff(self, path: Path, text: str) -> bool:
        """Whether the text begins with the format's name, whatever the file is called."""
        return text.lstrip()[:7] == "QGC WPL"

    def parse(self, text: str, source: str) -> Itinerary:
        r"""The items of a ``QGC WPL`` text.

        >>> lines = ["0 1 0 16 0 0 0 0 47.1 8.2 400 1", "1 0 3 16 5 0 0 0 47.2 8.2 9 1"]
        >>> itinerary = QgcWpl().parse("\n".join(["QGC WPL 110", *lines]), "tour.waypoints")
        >>> itinerary.home.altitude, len(itinerary.items), itinerary.items[0].params[0]
        (400.0, 1, 5.0)
        """
        lines = text.splitlines()
        header = _HEADER.match(lines[0].strip()) if lines else None
        if header is None:
            problem = "the first line isn't a header"
            raise refusal(source, Place("", 1, 1), problem, "it should be QGC WPL 110")
        if header[1] not in _VERSIONS:
            problem = f"version {header[1]} of the format isn't known"
            raise refusal(source, Place("", 1, header.start(1) + 1), problem, "it should be 110")
        items: list[Item] = []
        faults: list[Fault] = []
        for number, line in enumerate(lines[1:], start=2):
            if not line.strip() or line.lstrip().startswith("#"):
                continue
            found = _item(source, number, line)
            if isinstance(found, Item):
                items.append(found)
            else:
                faults += found
        if faults:
            raise MissionError(faults)
        return _with_home(source, items)

    def write(self, mission: Mission, where: Whereabouts) -> Written:
        """A mission as a ``QGC WPL 110`` text.

        Start, via points and goal are way points with their dwells as hold times; obstacles, fences
        and bounds are fence items behind them. Home is the start, so reading the text gives a
        mission with its 0, 0 there; every point has a height, 0 if the mission is flat.

        Args:
            mission: The mission.
            where: With the latitude and longitude of its 0, 0, where they aren't those that the
                mission says.

        Raises:
            OutputError: There is no origin, or the mission reaches too far from it.

        >>> mission = Mission.model_validate({"route": {"start": [0, 0], "goal": [90, 0]}})
        >>> text, _ = QgcWpl().write(mission, Whereabouts(origin=(47.0, 8.0)))
        >>> print(text.splitlines()[-1].replace(chr(9), " "))
        2 0 3 16 0 0 0 0 46.9999999939 8.0011833386 0 1
        """
        itinerary = itinerary_of(mission, where.origin or mission.world.origin_deg)
        more: list[tuple[str, str]] = []
        if mission.robot.max_speed_mps != RobotSpec().max_speed_mps:
            more.append(("robot", "max_speed_mps"))
        if mission.world.ground is not None:
            more.append(("world", "ground"))
        if any(mission.route.start.at[:2]):
            more.append(("place of the origin: read again, 0, 0 is at the start", "route.start"))
        return Written(wpl_text(itinerary), lost_of(itinerary, *more))


def wpl_text(itinerary: Itinerary) -> str:
    """The text of an itinerary: home, items, fences."""
    return "\n".join(("QGC WPL 110", *_lines(itinerary))) + "\n"


def _item(source: str, line_number: int, line: str) -> Item | list[Fault]:
    """One line: an item, or what is wrong with it."""
    fields = list(_FIELD.finditer(line))
    if len(fields) != len(_COLUMNS):
        place = Place("", line_number, 1)
        problem = f"the line has {len(fields)} fields instead of {len(_COLUMNS)}"
        return [fault_at(source, place, problem, "the fields are " + ", ".join(_COLUMNS))]
    values: dict[str, float] = {}
    faults: list[Fault] = []
    for name, found in zip(_COLUMNS, fields, strict=True):
        value = _number(found[0])
        is_whole = value is not None and math.isfinite(value) and value == int(value)
        if value is None or math.isinf(value) or (name in _WHOLE_NUMBERS and not is_whole):
            place = Place(name, line_number, found.start() + 1)
            remedy = (
                "it should be a whole number" if name in _WHOLE_NUMBERS else "it should be a number"
            )
            faults.append(fault_at(source, place, f'found "{found[0]}"', remedy))
        else:
            values[name] = value
    if faults:
        return faults
    number = int(values["number"])
    return Item(
        number=number,
        command=int(values["command"]),
        frame=int(values["frame"]),
        params=(values["param1"], values["param2"], values["param3"], values["param4"]),
        latitude=values["latitude"],
        longitude=values["longitude"],
        altitude=values["altitude"],
        place=Place(f"item {number}", line_number, 1),
        over_terrain=values["altitude"] if values["frame"] in TERRAIN else math.nan,
    )


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _with_home(source: str, items: list[Item]) -> Itinerary:
    """Take item 0 as the home position, if it looks like one."""
    if items and items[0].number == 0 and items[0].command == 16 and items[0].frame in ABSOLUTE:
        first = items[0]
        home = Home(first.latitude, first.longitude, first.altitude, first.place)
        return Itinerary(source, tuple(items[1:]), home)
    return Itinerary(source, tuple(items))


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
    params = tuple(0.0 if math.isnan(param) else param for param in item.params)
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
        *map(_number_text, params),
        *(f"{degrees:.10f}" for degrees in place),
        _number_text(height),
        "1",
    ]
    return "\t".join(fields)


def _number_text(value: float) -> str:
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)
