"""Voxels that have a file of their own, as a mission asks for them.

Tested through ``mission/space/test_spatial_keys``.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import BeforeValidator

from viaspline.maps.reading import Unknown
from viaspline.mission.annotations import Expects
from viaspline.mission.fields import METRES, Length, Name, Point3, as_text
from viaspline.mission.value import Value

VOXEL_WORDS = "{file: plant.bt}, with a .bt or .3dmap file"


class VoxelSpec(
    Value,
    expected=VOXEL_WORDS,
    examples=(
        {"file": "maps/plant.3dmap", "cell_m": 0.5, "origin_m": [100, 50, 0]},
        {"file": "site.bt", "unknown": "free"},
    ),
):
    """Voxels that have a file of their own.

    Attributes:
        file: The file, relative to the mission's: an OctoMap (``.bt``) or HOG2's voxels
            (``.3dmap``).
        unknown: What to make of space that nobody has seen, inside of the box round all that was.
            None: it is blocked. Nothing is unknown in a ``.3dmap``.
        cell_m: Side of a cube of a ``.3dmap`` [m]. None: 1 m. An OctoMap has its own.
        origin_m: Where the file's own ``0, 0, 0`` lies, ``[x, y, z]`` [m].
    """

    file: Annotated[Name, BeforeValidator(as_text), Expects("the path of a file such as plant.bt")]
    unknown: Unknown | None = None
    cell_m: Length | None = None
    origin_m: Annotated[Point3, METRES] = (0.0, 0.0, 0.0)
