"""The YAML file of a map of ROS's map_server.

Tested through ``maps/test_map_server``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Final, TypeVar

from viaspline.errors import Fault, MissionError
from viaspline.maps.grid import LARGEST_CELL_M, Origin
from viaspline.maps.marked import Marked, read_mapping
from viaspline.maps.occupancy import MODES, Meaning, Mode

_KEYS: Final = ("image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh")
_REMEDY: Final = "it should be a mapping with the keys " + ", ".join(_KEYS) + " (and mode)"
_FARTHEST_ORIGIN_M: Final = 5e8  # all of the largest map is then where a mission may be

T = TypeVar("T")


@dataclass(frozen=True)
class MapServerKeys:
    """What the YAML file of a map says.

    Attributes:
        image: The path of the picture.
        resolution: Side of a square [m].
        origin: x, y [m] of the lower left corner, and yaw [rad].
        meaning: What the pixels mean.
    """

    image: Marked
    resolution: float
    origin: Origin
    meaning: Meaning

    @classmethod
    def parse(cls, path: Path, text: str) -> MapServerKeys:
        r"""Read the keys.

        Raises:
            MissionError: It isn't a YAML mapping, or keys are missing or make no sense; all faults.

        >>> lines = "image: a.pgm", "resolution: -1", "origin: [0, 0]"
        >>> MapServerKeys.parse(Path("a.yaml"), "\n".join(lines))
        Traceback (most recent call last):
        viaspline.errors.MissionError: a.yaml:1:1: negate: is missing; give negate: 0 or 1
        ...
        a.yaml:2:13: resolution: found -1; it should be a number of metres greater than 0
        a.yaml:3:9: origin: found a list of 2; it should be [x, y, yaw] in metres and radians
        """
        keys = _Reader(path, read_mapping(path, text, _REMEDY))
        image = keys.get("image", "the path of a PGM or PNG", _name)
        resolution = keys.get("resolution", "a number of metres greater than 0", _side)
        origin = keys.get("origin", "[x, y, yaw] in metres and radians", _origin)
        negate = keys.get("negate", "0 or 1", lambda value: value.truth)
        occupied = keys.get("occupied_thresh", "a number from 0 to 1", _fraction)
        free = keys.get("free_thresh", "a number from 0 to 1", _fraction)
        mode: Mode | None = MODES[0]
        if "mode" in keys.values:
            mode = keys.get("mode", "trinary, scale or raw", _mode)
        if occupied is not None and free is not None and occupied <= free:
            keys.wrong("occupied_thresh", f"greater than free_thresh, which is {free:g}")
        if keys.faults or image is None or resolution is None or origin is None:
            raise MissionError(sorted(keys.faults, key=lambda fault: fault.line or 0))
        meaning = Meaning(mode or MODES[0], bool(negate), occupied or 0.0, free or 0.0)
        return cls(image, resolution, origin, meaning)


class _Reader:
    """The values of the keys, and the faults that were found."""

    def __init__(self, path: Path, values: dict[str, Marked]) -> None:
        self.path = path
        self.values = values
        self.faults: list[Fault] = []

    def get(self, key: str, expected: str, parse: Callable[[Marked], T | None]) -> T | None:
        """The value of a key; None, and a fault, if it is missing or can't be parsed."""
        value = self.values.get(key)
        if value is None:
            fault = Fault(key, "is missing", f"give {key}: {expected}", str(self.path), 1, 1)
            self.faults.append(fault)
            return None
        parsed = parse(value)
        if parsed is None:
            self.wrong(key, expected)
        return parsed

    def wrong(self, key: str, expected: str) -> None:
        """Note that a key has another value than it should."""
        value = self.values[key]
        remedy = f"it should be {expected}"
        self.faults.append(Fault(key, f"found {value}", remedy, str(self.path), *value.at))


def _name(value: Marked) -> Marked | None:
    return value if value.text else None


def _side(value: Marked) -> float | None:
    return value.number if value.number is not None and 0 < value.number <= LARGEST_CELL_M else None


def _fraction(value: Marked) -> float | None:
    return value.number if value.number is not None and 0 <= value.number <= 1 else None


def _origin(value: Marked) -> Origin | None:
    numbers = [item.number for item in value.items]
    sound = [
        number for number in numbers if number is not None and abs(number) <= _FARTHEST_ORIGIN_M
    ]
    return (sound[0], sound[1], sound[2]) if len(numbers) == len(sound) == 3 else None


def _mode(value: Marked) -> Mode | None:
    return next((mode for mode in MODES if mode == value.text), None)
