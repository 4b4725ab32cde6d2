"""Which kinds of files with voxels and with terrain there are.

Tested through ``mission/space/test_read_solids``.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from viaspline.errors import GeometryError
from viaspline.maps.map_faults import refusal
from viaspline.maps.reading import Unknown
from viaspline.maps.terrain import Terrain
from viaspline.maps.voxels import Corner, Voxels


def read_voxels(
    path: Path,
    unknown: Unknown | None,
    cell: float | None,
    origin: Corner,
    source: str | None = None,
) -> Voxels:
    """Read a file of voxels.

    Args:
        path: The file.
        unknown: What to make of cubes that nobody has seen; None: they are blocked.
        cell: Side of a cube [m], for files that don't say.
        origin: Where the file's own ``0, 0, 0`` lies [m].
        source: What the voxels' file is called; ``path`` if it isn't given.

    Raises:
        MissionError: The file can't be read or makes no sense, or has no use for an argument.
    """
    with _placed(path):
        return _read_voxels(path, unknown, cell, origin, source)


def _read_voxels(
    path: Path, unknown: Unknown | None, cell: float | None, origin: Corner, source: str | None
) -> Voxels:
    suffix = path.suffix.lower()
    if suffix == ".3dmap":
        from viaspline.maps.hog2_voxels import read_hog2_voxels

        if unknown is not None:
            problem = "nothing is unknown in it"
            raise refusal(path, problem, "leave out unknown", key="unknown")
        return read_hog2_voxels(path, cell, origin, source=source)
    if suffix == ".bt":
        from viaspline.maps.octomap import read_octomap

        if cell is not None:
            problem = "an OctoMap has its own resolution"
            raise refusal(path, problem, "leave out cell_m", key="cell_m")
        return read_octomap(path, unknown or "blocked", origin, source=source)
    problem = "is a kind of voxels that isn't understood"
    raise refusal(path, problem, "understood are OctoMap (.bt) and HOG2 (.3dmap)")


def read_terrain(
    path: Path, origin: tuple[float, float] = (0.0, 0.0), source: str | None = None
) -> Terrain:
    """Read the file of a terrain.

    Args:
        path: The file.
        origin: What of the file's own coordinates is the mission's 0, 0 [m].
        source: What the terrain's file is called; ``path`` if it isn't given.

    Raises:
        MissionError: The file can't be read or makes no sense.
    """
    with _placed(path):
        terrain = _read_terrain(path, source)
        if origin == (0.0, 0.0):
            return terrain
        x, y = terrain.origin
        return replace(terrain, origin=(x - origin[0], y - origin[1]))


def _read_terrain(path: Path, source: str | None) -> Terrain:
    suffix = path.suffix.lower()
    if suffix in (".tif", ".tiff"):
        from viaspline.maps.geotiff import read_geotiff

        return read_geotiff(path, source=source)
    if suffix == ".asc":
        from viaspline.maps.esri_ascii import read_esri_ascii

        return read_esri_ascii(path, source=source)
    problem = "is a kind of terrain that isn't understood"
    raise refusal(path, problem, "understood are GeoTIFF (.tif) and ASCII grids (.asc)")


@contextmanager
def _placed(path: Path) -> Iterator[None]:
    """What is wrong with the numbers of a file, told with its name."""
    try:
        yield
    except GeometryError as error:
        problem, _, remedy = str(error).partition("; ")
        raise refusal(path, problem, remedy or "correct it") from None
