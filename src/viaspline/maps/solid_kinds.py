"""Which kinds of files with voxels and with terrain there are.

Tested through ``mission/space/test_read_solids``.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

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
    suffix = path.suffix.lower()
    if suffix in (".tif", ".tiff"):
        from viaspline.maps.geotiff import read_geotiff

        terrain = read_geotiff(path, source=source)
    elif suffix == ".asc":
        from viaspline.maps.esri_ascii import read_esri_ascii

        terrain = read_esri_ascii(path, source=source)
    else:
        problem = "is a kind of terrain that isn't understood"
        raise refusal(path, problem, "understood are GeoTIFF (.tif) and ASCII grids (.asc)")
    if origin == (0.0, 0.0):
        return terrain
    x, y = terrain.origin
    return replace(terrain, origin=(x - origin[0], y - origin[1]))
