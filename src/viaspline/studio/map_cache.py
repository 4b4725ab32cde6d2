"""Maps of a mission document, read once: while something is dragged, no map is read again.

Tested through ``studio/test_server``.
"""

from __future__ import annotations

import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from pydantic import ValidationError

from viaspline.bounded_file import MAP_FILE, read_text
from viaspline.errors import Fault, MissionError
from viaspline.maps.grid import Grid
from viaspline.maps.map_server_keys import MapServerKeys
from viaspline.mission.map_spec import MapSpec
from viaspline.mission.resolve_files import obstacles_of
from viaspline.mission.schema_errors import schema_faults
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.tracks_spec import TracksSpec
from viaspline.mission.unplaced_faults import located
from viaspline.studio.document import Document
from viaspline.studio.folder import Folder

OBSTACLE_LISTS = ("known", "unseen")
MAX_KEPT_MAPS = 32


@dataclass(frozen=True)
class ExpandedDocument:
    """A document with obstacles in place of maps.

    Attributes:
        data: For ``Mission.model_validate``.
        places: For each list under ``world``, the item that each obstacle came from.
    """

    data: Document
    places: Mapping[str, Sequence[int]]

    def original(self, path: tuple[str | int, ...]) -> tuple[str | int, ...]:
        """Where in the document something of ``data`` stands."""
        if len(path) < 3 or path[0] != "world" or not isinstance(path[2], int):
            return path
        places = self.places.get(str(path[1]), ())
        return (*path[:2], places[path[2]], *path[3:]) if path[2] < len(places) else path


class MapCache:
    """The maps of the files in a folder.

    Args:
        folder: No map, and no picture of a map, is read from elsewhere.
    """

    def __init__(self, folder: Folder) -> None:
        self._folder = folder
        self._kept: dict[Any, Sequence[Obstacle]] = {}

    def unfold(self, document: Document, base: Path) -> ExpandedDocument:
        """The document with its maps read.

        Args:
            document: Sound or not.
            base: The folder of the mission's file.

        Raises:
            MissionError: A map can't be read or lies outside of the folder.
        """
        document = self.with_corridor(document, base)
        world = document.get("world")
        if not isinstance(world, Mapping):
            return ExpandedDocument(document, {})
        unfolded: dict[str, Any] = dict(world)
        places: dict[str, list[int]] = {}
        for key in OBSTACLE_LISTS:
            items = world.get(key)
            if not isinstance(items, list) or not any(map(_is_file, items)):
                continue
            taken = {item.get("name") for item in items if isinstance(item, Mapping)}
            unfolded[key], places[key] = [], []
            for i, item in enumerate(items):
                found: Sequence[Any] = [item]
                if _is_file(item):
                    found = self._read(item, f"world.{key}[{i}]", base, taken)
                unfolded[key] += found
                places[key] += [i] * len(found)
        return ExpandedDocument({**document, "world": unfolded} if places else document, places)

    def with_corridor(self, document: Document, base: Path, prefix: str = "") -> Document:
        """What has a route, with the file of its corridor named from anywhere.

        Args:
            document: A mission, or a robot of a fleet.
            base: The folder of its file.
            prefix: Of its keys: where it stands.

        Raises:
            MissionError: The corridor lies outside of the folder.
        """
        route = document.get("route")
        corridor = route.get("corridor") if isinstance(route, Mapping) else None
        name = corridor.get("csv") if isinstance(corridor, Mapping) else None
        if not isinstance(route, Mapping) or not isinstance(name, str) or not corridor:
            return document
        try:
            path = self.within(name, base)
        except MissionError as error:
            fault = error.faults[0]
            key = f"{prefix}route.corridor.csv"
            raise MissionError([Fault(key, f"{name}: {fault.problem}", fault.remedy)]) from None
        return {**document, "route": {**route, "corridor": {**corridor, "csv": str(path)}}}

    def _read(
        self, item: Mapping[str, Any], key: str, base: Path, taken: set[Any]
    ) -> Sequence[Obstacle]:
        asked = "map" if "map" in item else "tracks"
        try:
            spec = (MapSpec if asked == "map" else TracksSpec).model_validate(dict(item))
        except ValidationError as error:
            path: tuple[str | int, ...] = ("world", key.split(".")[1].split("[")[0])
            index = int(key.split("[")[1][:-1])
            raise MissionError(located(schema_faults(error, (*path, index)), {}, None)) from None
        try:
            files = self._files(spec, base)
            stamp = tuple(file_stamp(file) for file in files)
            name = (json.dumps(item, sort_keys=True), str(base), stamp)
            if name not in self._kept:
                while len(self._kept) >= MAX_KEPT_MAPS:
                    del self._kept[next(iter(self._kept))]
                self._kept[name] = obstacles_of(spec, base, set(taken))
            return self._kept[name]
        except MissionError as error:
            faults = [
                Fault(f"{key}.{asked}", f"{fault.source}: {fault.problem}", fault.remedy)
                for fault in error.faults
            ]
            raise MissionError(faults) from None

    def _files(self, spec: MapSpec | TracksSpec, base: Path) -> list[Path]:
        """The files of a map or of tracks, all of them within the folder."""
        if isinstance(spec, TracksSpec):
            return [self.within(spec.tracks, base)]
        path = self.within(spec.map, base)
        if path.suffix.lower() not in (".yaml", ".yml"):
            return [path]
        image = MapServerKeys.parse(path, read_text(path, MAP_FILE)).image.text or ""
        return [path, self.within(str(Path(image).expanduser()), path.parent)]

    def within(self, name: str, base: Path) -> Path:
        """The path of a file that is named from a folder.

        Raises:
            MissionError: It lies outside of the studio's folder.
        """
        try:
            path = (base / name).resolve()
        except (OSError, RuntimeError):
            problem, remedy = "leads nowhere", "give the name of a file"
            raise MissionError([Fault("map", problem, remedy, source=name)]) from None
        if not path.is_relative_to(self._folder.root):
            problem = "lies outside of the studio's folder"
            remedy = "start the studio with a folder that holds the file as well"
            raise MissionError([Fault("map", problem, remedy, source=name)])
        return path


def _is_file(item: Any) -> bool:
    return isinstance(item, Mapping) and ("map" in item or "tracks" in item)


def file_stamp(path: Path) -> tuple[str, int, int]:
    """What changes when a file does: path, time and size."""
    try:
        stat = path.stat()
    except OSError:
        return str(path), 0, 0
    return str(path), stat.st_mtime_ns, stat.st_size


def grid_name(grid: Grid) -> str:
    """What the picture of a grid is called."""
    return grid.digest.hex()


def grid_png(grid: Grid) -> bytes:
    """A grid as a grey picture, top row first: 0 blocked, 128 unknown, 255 free."""
    from PIL import Image

    cells = np.where(grid.blocked, np.uint8(0), np.uint8(255))
    if grid.unknown is not None:
        cells[grid.unknown] = 128
    buffer = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(cells[::-1])).save(buffer, "PNG", compress_level=3)
    return buffer.getvalue()
