"""Files of voxels and of terrain read and put in the place of what asks for them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path as FilePath
from typing import Any, NamedTuple

from pydantic import TypeAdapter, ValidationError

from viaspline.errors import MissionError
from viaspline.maps.solid_kinds import read_terrain, read_voxels
from viaspline.mission.space.ground_spec import Origin2
from viaspline.mission.space.voxel_spec import VoxelSpec
from viaspline.mission.unplaced_faults import Path, UnplacedFault, children, of_file

GROUND: Path = ("world", "ground")


class ReadGround(NamedTuple):
    """A mission's data with its terrain read.

    Attributes:
        data: The data; without its ground if that couldn't be read.
        faults: What was wrong with the file.
    """

    data: Any
    faults: list[UnplacedFault]


def read_ground(data: Any, folder: FilePath) -> ReadGround:
    """Read the file of the ground.

    Args:
        data: What a mission file holds, sound or not.
        folder: Where the file is looked for.
    """
    top = children(data) or {}
    world = children(top.get("world")) or {}
    ground = children(world.get("ground")) or {}
    name = ground.get("terrain")
    if not isinstance(name, str | FilePath) or not str(name):
        return ReadGround(data, [])
    try:
        origin = TypeAdapter(Origin2).validate_python(ground.get("origin_m", (0.0, 0.0)))
    except ValidationError:  # told where the ground is validated
        origin = (0.0, 0.0)
    try:
        terrain = read_terrain(folder / name, origin, source=str(name))
    except MissionError as error:
        faults = [of_file(GROUND, "terrain", fault) for fault in error.faults]
        without = {key: value for key, value in world.items() if key != "ground"}
        return ReadGround({**top, "world": without}, faults)
    read = {**ground, "terrain": terrain}
    return ReadGround({**top, "world": {**world, "ground": read}}, [])


def is_voxel_file(item: Any) -> bool:
    """Whether an obstacle asks for a file of voxels."""
    voxels = item.get("voxels") if isinstance(item, Mapping) else None
    return isinstance(voxels, Mapping) and not hasattr(voxels.get("blocked"), "dtype")


def with_voxels(
    item: Mapping[str, Any], path: Path, folder: FilePath
) -> tuple[list[dict[str, Any]], list[UnplacedFault]]:
    """An obstacle with its voxels read, or what is wrong with what it asks for.

    Args:
        item: The obstacle's data.
        path: Where it stands.
        folder: Where the file is looked for.
    """
    asking = (*path, "voxels")
    try:
        spec = VoxelSpec.model_validate(item["voxels"])
    except ValidationError as error:
        from viaspline.mission.schema_errors import schema_faults

        return [], schema_faults(error, asking)
    try:
        read = read_voxels(
            folder / spec.file, spec.unknown, spec.cell_m, spec.origin_m, source=spec.file
        )
    except MissionError as error:
        return [], [of_file(asking, "file", fault) for fault in error.faults]
    return [{**item, "voxels": read}], []
