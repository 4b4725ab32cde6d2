"""What a mission or a fleet has from files of its own, as it is written: by their names.

Tested through ``mission/test_resolve_files`` and ``mission/test_corridors``.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from viaspline.errors import OutputError
from viaspline.maps.grid import Grid
from viaspline.maps.terrain import Terrain
from viaspline.maps.voxels import Voxels
from viaspline.mission.map_edge import edge_of
from viaspline.mission.route_spec import Route
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.world_spec import WorldSpec


def world_data(world: WorldSpec, data: Mapping[str, Any], folder: Path) -> dict[str, Any]:
    """The world's data, or a part of it, with files named, without the bounds that maps bring."""
    edge = edge_of([item.grid for item in world.known if item.grid is not None])
    written = dict(data)
    for key, items in (("known", world.known), ("unseen", world.unseen)):
        if items and key in data:
            pairs = zip(data[key], items, strict=True)
            written[key] = [_obstacle(plain, item, folder) for plain, item in pairs]
    if world.bounds is not None and world.bounds == edge.bounds:
        written.pop("bounds", None)
    if world.bounds is None and edge.fence in world.fences:
        written["fences"] = [ring for ring in world.fences if ring != edge.fence]
    if world.ground is not None and world.ground.terrain is not None:
        name = _named(world.ground.terrain, "the ground is a terrain", folder)
        written["ground"] = {**written["ground"], "terrain": name}
    # A mapping that is empty stands for one with nothing but default values.
    return {key: value for key, value in written.items() if value or value == {}}


def _obstacle(plain: Mapping[str, Any], obstacle: Obstacle, folder: Path) -> Mapping[str, Any]:
    called = f"obstacle '{obstacle.name}'" if obstacle.name else "an obstacle"
    if obstacle.voxels is not None:
        return {**plain, "voxels": _voxels(obstacle.voxels, called, folder)}
    grid = obstacle.grid
    if grid is None:
        return plain
    name = _named(grid, f"{called} is a grid", folder)
    reading = grid.reading
    asked = {
        "map": name,
        "unknown": "free" if reading is not None and reading.unknown == "free" else None,
        "resolution_m": None if reading is None else reading.resolution,
        "name": obstacle.name,
        "height_m": obstacle.height_m,
    }
    return {key: value for key, value in asked.items() if value is not None}


def _voxels(voxels: Voxels, called: str, folder: Path) -> dict[str, Any]:
    """The file of voxels, with what else was asked of it."""
    asked: dict[str, Any] = {"file": _named(voxels, f"{called} is voxels", folder)}
    reading = voxels.reading
    if reading is not None and reading.unknown == "free":
        asked["unknown"] = "free"
    if reading is not None and reading.resolution is not None:
        asked["cell_m"] = reading.resolution
    if reading is not None and any(reading.origin):
        asked["origin_m"] = reading.origin
    return asked


def _named(value: Grid | Voxels | Terrain, what: str, folder: Path) -> str:
    """The file that something was read from, as it is written in a folder."""
    if value.reading is None or value.source is None:
        problem = f"{what} made in memory, which can't be written; read it from a file"
        raise OutputError("<mission>", problem)
    given = value.source
    return given if Path(given).is_absolute() else relative(value.reading.path, folder)


def relative(path: Path, folder: Path) -> str:
    """The path of a file as it is written in a folder."""
    return Path(os.path.relpath(path, folder)).as_posix()


def route_data(route: Route, data: Mapping[str, Any], folder: Path) -> Mapping[str, Any]:
    """A route's data with the file of its corridor named, from the folder of what is written."""
    if route.corridor is None or route.corridor.csv is None:
        return data
    return {**data, "corridor": {"csv": relative(Path(route.corridor.csv), folder)}}
