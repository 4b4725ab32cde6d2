"""Which kinds of map files there are: those of squares, and those of areas.

Tested through ``mission/test_resolve_files``.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final

from viaspline.bounded_file import is_folder
from viaspline.maps.area import Area
from viaspline.maps.grid import Grid
from viaspline.maps.map_faults import refusal
from viaspline.maps.reading import Unknown

_OF_SQUARES: Final = (".yaml", ".yml", ".map")
_OF_AREAS: Final = (".svg", ".geojson", ".json")
_PICTURES: Final = (".pgm", ".png", ".bmp")
UNDERSTOOD: Final = (
    "understood are ROS's map_server (.yaml, .yml), MovingAI (.map), SVG (.svg) and GeoJSON "
    "(.geojson, .json)"
)


def is_of_squares(path: Path) -> bool:
    """Whether a map is read as a grid, rather than as areas.

    Raises:
        MissionError: By its suffix it is neither.

    >>> is_of_squares(Path("depot.yaml")), is_of_squares(Path("parking.svg"))
    (True, False)
    """
    suffix = path.suffix.lower()
    if suffix in _PICTURES:
        remedy = "give the YAML file of ROS's map_server that names it and says how large it is"
        raise refusal(path, "is a picture, not a map", remedy)
    if suffix not in _OF_SQUARES + _OF_AREAS:
        problem = "is a folder" if is_folder(path) else "is a kind of map that isn't understood"
        raise refusal(path, problem, UNDERSTOOD)
    return suffix in _OF_SQUARES


def read_grid(
    path: Path, unknown: Unknown | None, resolution: float | None, source: str | None = None
) -> Grid:
    """Read a map of squares.

    Args:
        path: The file.
        unknown: What to make of squares that nobody has seen; None: they are blocked.
        resolution: Side of a square [m], for maps that don't say.
        source: What the grid's file is called; ``path`` if it isn't given.

    Raises:
        MissionError: The file can't be read or makes no sense, or has no use for an argument.
    """
    if path.suffix.lower() == ".map":
        from viaspline.maps.movingai import read_movingai

        if unknown is not None:
            problem = "nothing is unknown in a map of MovingAI"
            raise refusal(path, problem, "leave out unknown", key="unknown")
        return read_movingai(path, resolution, source=source)
    from viaspline.maps.map_server import read_map_server

    if resolution is not None:
        problem = "a map of map_server has its own resolution"
        raise refusal(path, problem, "leave out resolution_m", key="resolution_m")
    return read_map_server(path, unknown or "blocked", source=source)


def read_areas(path: Path, unknown: Unknown | None, resolution: float | None) -> tuple[Area, ...]:
    """Read a map of areas.

    Args:
        path: The file.
        unknown: Has to be None: whatever isn't drawn is free.
        resolution: Length of a unit of a drawing [m].

    Raises:
        MissionError: The file can't be read or makes no sense, or has no use for an argument.

    Warns:
        MissionWarning: For what has no area.
    """
    if unknown is not None:
        raise refusal(path, "nothing is unknown in it", "leave out unknown", key="unknown")
    if path.suffix.lower() == ".svg":
        from viaspline.maps.svg import read_svg

        return read_svg(path, 1.0 if resolution is None else resolution)
    from viaspline.maps.geojson import read_geojson

    if resolution is not None:
        problem = "GeoJSON is taken to be in metres"
        raise refusal(path, problem, "leave out resolution_m", key="resolution_m")
    return read_geojson(path)
