"""Maps, tracks, voxels and terrain read and put in the place of what asks for them.

``{map: depot.yaml}`` becomes an obstacle with a grid, ``{map: site.geojson}`` as many obstacles as
there are polygons, ``{tracks: people.csv}`` as many moving discs as it has ids. What comes after
sees obstacles only.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path as FilePath
from typing import Any

from pydantic import ValidationError

from viaspline.errors import MissionError
from viaspline.maps.grid import Grid
from viaspline.maps.kinds import is_of_squares, read_areas, read_grid
from viaspline.mission.load_tracks import moving_discs
from viaspline.mission.map_edge import edge_of
from viaspline.mission.map_spec import MapSpec
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.space.read_solids import is_voxel_file, read_ground, with_voxels
from viaspline.mission.tracks_spec import TracksSpec
from viaspline.mission.unplaced_faults import Path, UnplacedFault, children, of_file


@dataclass(frozen=True)
class ResolvedFiles:
    """A mission's data without maps.

    Attributes:
        data: The data, with obstacles instead of maps.
        faults: What was wrong with the maps; those that couldn't be read are left out.
        places: For each obstacle under ``known`` and ``unseen``, the item that it came from; a
            list that has no map isn't there.
        edge: Paths of the bounds or the fence that the maps brought.
        unread: Paths of what asks for voxels or a terrain that couldn't be read.
    """

    data: Any
    faults: tuple[UnplacedFault, ...] = ()
    places: Mapping[str, Sequence[int]] = field(default_factory=dict)
    edge: frozenset[Path] = frozenset()
    unread: frozenset[Path] = frozenset()

    def original(self, path: Path) -> Path:
        """Where in the mission as it was given something stands."""
        if len(path) < 3 or path[0] != "world":
            return path
        places = self.places.get(str(path[1]), ())
        i = path[2]
        if not isinstance(i, int) or i >= len(places):
            return path
        return (*path[:2], places[i], *path[3:])


def resolve_maps(data: Any, folder: FilePath) -> ResolvedFiles:
    """Read the maps of a mission.

    Args:
        data: What a mission file holds, sound or not.
        folder: Where files of maps are looked for.

    Returns:
        The data with obstacles for maps; ``data`` itself if there is no grid.
    """
    data, of_ground = read_ground(data, folder)
    top = children(data) or {}
    world = children(top.get("world")) or {}
    lists = {key: world[key] for key in ("known", "unseen") if _is_list(world.get(key))}
    if not any(_is_file(item) or _grid_of(item) for items in lists.values() for item in items):
        return ResolvedFiles(data, tuple(of_ground), unread=_unread(of_ground))
    taken = {_name_of(item) for items in lists.values() for item in items}
    faults = list(of_ground)
    places: dict[str, list[int]] = {}
    resolved = dict(world)
    for key, items in lists.items():
        places[key], resolved[key] = [], []
        for i, item in enumerate(items):
            obstacles, found = _of_item(item, ("world", key, i), folder, taken)
            places[key] += [i] * len(obstacles)
            resolved[key] += obstacles
            faults += found
    edge = frozenset[Path]() if faults else _bring_edge(resolved)
    whole = {**top, "world": resolved}
    return ResolvedFiles(whole, tuple(faults), places, edge, _unread(faults))


def _unread(faults: Sequence[UnplacedFault]) -> frozenset[Path]:
    """Paths of what asks for voxels or terrain that couldn't be read."""
    asking = ("terrain", "file", "voxels")
    return frozenset(fault.path for fault in faults if fault.path[-1] in asking)


def _is_list(value: Any) -> bool:
    return isinstance(value, list | tuple)


def _is_file(item: Any) -> bool:
    is_list = isinstance(item, Mapping) and ("map" in item or "tracks" in item)
    return is_list or is_voxel_file(item)


def _grid_of(item: Any) -> Grid | None:
    grid = item.get("grid") if isinstance(item, Mapping) else getattr(item, "grid", None)
    return grid if isinstance(grid, Grid) else None


def _name_of(item: Any) -> Any:
    name = item.get("name") if isinstance(item, Mapping) else getattr(item, "name", None)
    return name if isinstance(name, str) else None


def _of_item(
    item: Any, path: Path, folder: FilePath, taken: set[Any]
) -> tuple[Sequence[Any], Sequence[UnplacedFault]]:
    """The obstacles of an item that may be a map or tracks, or what is wrong with it."""
    if not _is_file(item):
        return [item], ()
    if "map" not in item and "tracks" not in item:
        return with_voxels(item, path, folder)
    key = "map" if "map" in item else "tracks"
    try:
        spec = (MapSpec if key == "map" else TracksSpec).model_validate(dict(item))
        return obstacles_of(spec, folder, taken), ()
    except ValidationError as error:
        from viaspline.mission.schema_errors import schema_faults

        return (), schema_faults(error, path)
    except MissionError as error:
        return (), [of_file(path, key, fault) for fault in error.faults]


def obstacles_of(spec: MapSpec | TracksSpec, folder: FilePath, taken: set[Any]) -> list[Obstacle]:
    """The obstacles of a map, or of a file of tracks.

    Args:
        spec: The map or the tracks.
        folder: Where its file is looked for.
        taken: Names that other obstacles have; those that are given here are added.

    Raises:
        MissionError: The file can't be read or makes no sense.
    """
    if isinstance(spec, TracksSpec):
        return moving_discs(spec, folder, lambda name: _free(name, taken))
    path = folder / spec.map
    keys = ("pass_on", "never_pass_on", "height_m")
    said = {key: value for key in keys if (value := getattr(spec, key)) is not None}
    if is_of_squares(path):
        grid = read_grid(path, spec.unknown, spec.resolution_m, source=spec.map)
        return [Obstacle.model_validate({"grid": grid, "name": spec.name} | said)]
    areas = read_areas(path, spec.unknown, spec.resolution_m)
    obstacles = []
    for number, area in enumerate(areas, start=1):
        name = area.name
        if spec.name is not None:
            name = spec.name if len(areas) == 1 else f"{spec.name} {area.name or number}"
        if name is not None and name != spec.name:
            name = _free(name, taken)
        shape = {"polygon": area.outline, "holes": area.holes, "name": name}
        obstacles.append(Obstacle.model_validate(shape | said))
    return obstacles


def _free(name: str, taken: set[Any]) -> str:
    """The name, or the name with a number, so that no other obstacle has it."""
    number, free = 2, name
    while free in taken:
        number, free = number + 1, f"{name}-{number}"
    taken.add(free)
    return free


def _bring_edge(world: dict[str, Any]) -> frozenset[Path]:
    """Keep the robot on the maps that are known, if nobody said how far it may go."""
    fences = world.get("fences") or ()
    if world.get("bounds") is not None or not _is_list(fences):
        return frozenset()
    known = world.get("known")
    items = known if isinstance(known, list | tuple) else ()
    edge = edge_of([grid for item in items if (grid := _grid_of(item)) is not None])
    if edge.bounds is not None:
        world["bounds"] = edge.bounds
        return frozenset({("world", "bounds")})
    if edge.fence is None or edge.fence in map(_corners, fences):
        return frozenset()
    world["fences"] = [*fences, edge.fence]
    return frozenset({("world", "fences", len(fences))})


def _corners(ring: Any) -> Any:
    """A ring as tuples, if it is one."""
    try:
        return tuple(map(tuple, ring))
    except TypeError:
        return None
