"""Voxels where a mission has them: as a value, as an array, or as the file that they are read from.

Tested through ``mission/shapes/test_solid_shapes``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, TypeAlias

from pydantic import BeforeValidator, InstanceOf

from viaspline.maps.reading import Reading
from viaspline.maps.voxels import Voxels
from viaspline.mission.annotations import Expects
from viaspline.mission.space.voxel_spec import VOXEL_WORDS, VoxelSpec


def _as_voxels(value: Any) -> Any:
    """An array as cubes of 1 m, and the voxels that ``model_dump`` took apart."""
    if hasattr(value, "dtype") and getattr(value, "ndim", 0) > 0:
        return Voxels(value, 1.0)
    if not isinstance(value, Mapping) or not hasattr(value.get("blocked"), "dtype"):
        return value
    reading = value["reading"]
    parts = {key: item for key, item in value.items() if key != "digest"}
    return Voxels(**{**parts, "reading": None if reading is None else Reading(**reading)})


AnyVoxels: TypeAlias = Annotated[
    InstanceOf[Voxels],
    BeforeValidator(_as_voxels, json_schema_input_type=VoxelSpec),
    Expects(VOXEL_WORDS),
]
