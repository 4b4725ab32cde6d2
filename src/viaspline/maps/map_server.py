"""ROS's maps: a YAML file that names a picture, as map_server and Nav2 have them.

See http://wiki.ros.org/map_server.
"""

from __future__ import annotations

from pathlib import Path

from viaspline.bounded_file import MAP_FILE, read_text
from viaspline.errors import MissionError
from viaspline.kernels.arrays import Flags
from viaspline.maps.grid import Grid
from viaspline.maps.image import read_picture
from viaspline.maps.map_faults import refusal
from viaspline.maps.map_server_keys import MapServerKeys
from viaspline.maps.occupancy import squares_of
from viaspline.maps.reading import Reading, Unknown


def read_map_server(
    path: str | Path, unknown: Unknown = "blocked", *, source: str | None = None
) -> Grid:
    """Read a map of ROS's map_server or Nav2, in any of its modes.

    While it is read, a map takes two bytes a square that stay, and its picture: one byte a pixel
    for 8 bits of grey, two for 16, four for several channels. Most maps take little more than 3
    bytes a square, none much more than 6.

    Args:
        path: The YAML file; it names the picture, relative to itself.
        unknown: What to make of squares that are unknown.
        source: What the grid's file is called; ``path`` if it isn't given.

    Raises:
        MissionError: A file can't be read or makes no sense; every fault of the YAML at once, with
            line and column.

    >>> read_map_server("no-such-map.yaml")
    Traceback (most recent call last):
    viaspline.errors.MissionError: no-such-map.yaml: there is no such file; give the path of ...
    """
    file = Path(path)
    spec = MapServerKeys.parse(file, read_text(file, MAP_FILE))
    blocked, unseen = _squares(file, spec, unknown)
    name = str(path) if source is None else source
    reading = Reading(file.absolute(), unknown)
    return Grid(blocked, spec.resolution, spec.origin, name, unseen, reading)


def _squares(path: Path, spec: MapServerKeys, unknown: Unknown) -> tuple[Flags, Flags | None]:
    """The squares of the picture; what is wrong with it is the fault of the key that names it."""
    name = spec.image.text or ""
    try:
        picture = read_picture(path.parent / Path(name).expanduser())
        return squares_of(picture, spec.meaning, unknown)
    except MissionError as error:
        fault = error.faults[0]
        problem = f"{fault.source}: {fault.problem}"
        raise refusal(path, problem, fault.remedy, key="image", at=spec.image.at) from None
