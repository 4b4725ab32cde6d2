"""Files of voxels and of terrain, read once: while something is dragged, none is read again.

Tested through ``studio/space/test_spatial_server``.
"""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from viaspline.errors import Fault, MissionError
from viaspline.mission.space.read_solids import is_voxel_file, read_ground, with_voxels
from viaspline.mission.unplaced_faults import UnplacedFault, located
from viaspline.studio.document import Document
from viaspline.studio.map_cache import OBSTACLE_LISTS, ExpandedDocument, MapCache, file_stamp

MAX_KEPT_SOLIDS: Final = 8


class SolidFiles:
    """The voxels and terrains of the files in a folder.

    Args:
        maps: The maps of that folder: no file is read from elsewhere.
    """

    def __init__(self, maps: MapCache) -> None:
        self._maps = maps
        self._kept: dict[str, Any] = {}

    def unfold(self, document: Document, base: Path) -> ExpandedDocument:
        """The document with its maps, voxels and terrain read.

        Args:
            document: Sound or not.
            base: The folder of the mission's file.

        Raises:
            MissionError: A file can't be read or lies outside of the folder.
        """
        expanded = self._maps.unfold(document, base)
        world = expanded.data.get("world")
        if not isinstance(world, Mapping):
            return expanded
        unfolded = dict(world)
        if isinstance(ground := world.get("ground"), Mapping) and "terrain" in ground:
            unfolded["ground"] = self._ground(ground, base)
        for key in OBSTACLE_LISTS:
            items = world.get(key)
            if isinstance(items, list) and any(map(is_voxel_file, items)):
                unfolded[key] = [
                    self._voxels(item, f"world.{key}[{i}].voxels.file", base)
                    if is_voxel_file(item)
                    else item
                    for i, item in enumerate(items)
                ]
        return ExpandedDocument({**expanded.data, "world": unfolded}, expanded.places)

    def _ground(self, ground: Mapping[str, Any], base: Path) -> Any:
        name = ground["terrain"]
        if not isinstance(name, str) or not name:
            return ground
        key = self._key(name, base, {**ground}, "world.ground.terrain")
        if key not in self._kept:
            read = read_ground({"world": {"ground": dict(ground)}}, base)
            self._keep(key, base, read.data["world"].get("ground"), read.faults)
        return self._kept[key]

    def _voxels(self, item: Mapping[str, Any], place: str, base: Path) -> Any:
        name = item["voxels"].get("file")
        if not isinstance(name, str) or not name:
            return item
        key = self._key(name, base, item["voxels"], place)
        if key not in self._kept:
            path = (
                "world",
                place.split(".")[1].split("[")[0],
                int(place.split("[")[1].split("]")[0]),
            )
            found, faults = with_voxels({"voxels": item["voxels"]}, path, base)
            self._keep(key, base, found[0]["voxels"] if found else None, faults)
        return {**item, "voxels": self._kept[key]}

    def _key(self, name: str, base: Path, asked: Mapping[str, Any], place: str) -> str:
        try:
            path = self._maps.within(name, base)
        except MissionError as error:
            fault = error.faults[0]
            raise MissionError([Fault(place, f"{name}: {fault.problem}", fault.remedy)]) from None
        return json.dumps([asked, file_stamp(path)], sort_keys=True, default=str)

    def _keep(self, key: str, base: Path, found: Any, faults: Sequence[UnplacedFault]) -> None:
        if faults:
            told = located(list(faults), {}, None)
            here = f"{base}{os.sep}"  # a page needn't know where on the disk it is
            raise MissionError(
                [replace(one, problem=one.problem.replace(here, "")) for one in told]
            )
        while len(self._kept) >= MAX_KEPT_SOLIDS:
            del self._kept[next(iter(self._kept))]
        self._kept[key] = found
