"""``QGC WPL`` files: mission items as a table of text, one item a line, twelve fields.

Fields: number, current, frame, command, parameters 1 to 4, latitude, longitude, altitude,
autocontinue. By custom item 0 is the home position.
"""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Final

from viaspline.errors import Fault, MissionError
from viaspline.formats.file_faults import fault_at, refusal
from viaspline.formats.interpret import mission_of
from viaspline.formats.items import ABSOLUTE, Home, Item, Itinerary, Place
from viaspline.mission.model import Mission
from viaspline.mission.yaml_document import read_text

_HEADER: Final = re.compile(r"QGC\s+WPL\s+(\S+)")
_VERSIONS: Final = ("110", "120")
_FIELD: Final = re.compile(r"\S+")
_NAMES: Final = (
    "number", "current", "frame", "command", "param1", "param2", "param3", "param4",
    "latitude", "longitude", "altitude", "autocontinue",
)  # fmt: skip
_WHOLE: Final = frozenset({"number", "current", "frame", "command", "autocontinue"})


def read_qgc_wpl(path: str | Path) -> Mission:
    """Read a ``QGC WPL 110`` file.

    Args:
        path: The file, whatever its suffix.

    Raises:
        MissionError: The file can't be read or its mission has faults, each with its line.

    Warns:
        MissionWarning: One for each kind of item that a mission can't represent.
    """
    return mission_of(parse_qgc_wpl(read_text(path), str(path)))


def parse_qgc_wpl(text: str, source: str) -> Itinerary:
    r"""The items of a ``QGC WPL`` text.

    >>> lines = ["QGC WPL 110", "0 1 0 16 0 0 0 0 47.1 8.2 400 1", "1 0 3 16 5 0 0 0 47.2 8.2 9 1"]
    >>> itinerary = parse_qgc_wpl("\n".join(lines), "tour.waypoints")
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


def _item(source: str, line_number: int, line: str) -> Item | list[Fault]:
    """One line: an item, or what is wrong with it."""
    fields = list(_FIELD.finditer(line))
    if len(fields) != len(_NAMES):
        place = Place("", line_number, 1)
        problem = f"the line has {len(fields)} fields instead of {len(_NAMES)}"
        return [fault_at(source, place, problem, "the fields are " + ", ".join(_NAMES))]
    values: dict[str, float] = {}
    faults: list[Fault] = []
    for name, found in zip(_NAMES, fields, strict=True):
        value = _number(found[0])
        is_whole = value is not None and math.isfinite(value) and value == int(value)
        if value is None or math.isinf(value) or (name in _WHOLE and not is_whole):
            place = Place(name, line_number, found.start() + 1)
            remedy = "it should be a whole number" if name in _WHOLE else "it should be a number"
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
