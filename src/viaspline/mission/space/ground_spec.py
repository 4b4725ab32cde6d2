"""The ground under a spatial mission: flat, or a terrain's file.

Tested through ``mission/space/test_spatial_keys``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Any, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike
from pydantic import BeforeValidator, InstanceOf

from viaspline.kernels.arrays import Floats
from viaspline.maps.reading import Reading
from viaspline.maps.terrain import Terrain
from viaspline.mission.annotations import Expects
from viaspline.mission.fields import METRES, Coordinate, Name, Point2
from viaspline.mission.value import OneOf

NoData: TypeAlias = Literal["blocked", "free"]
Origin2: TypeAlias = Annotated[Point2, METRES]


def _as_terrain(value: Any) -> Any:
    """The terrain that ``model_dump`` took apart."""
    if not isinstance(value, Mapping) or not hasattr(value.get("heights"), "dtype"):
        return value
    reading = value["reading"]
    parts = {key: item for key, item in value.items() if key != "digest"}
    return Terrain(**{**parts, "reading": None if reading is None else Reading(**reading)})


TerrainFile: TypeAlias = Annotated[
    InstanceOf[Terrain],
    BeforeValidator(_as_terrain, json_schema_input_type=Name),
    Expects("the path of a terrain such as dem.tif or dem.asc"),
]


class GroundSpec(
    OneOf,
    expected="{flat_m: 0}, or {terrain: dem.tif} with a .tif or .asc file",
    exactly_one=("flat_m", "terrain"),
    needing=(("nodata", "terrain"), ("origin_m", "terrain")),
    examples=(
        {"flat_m": 400},
        {"terrain": "maps/hills.asc", "nodata": "free", "origin_m": [100, 50]},
    ),
):
    """How high the ground is. Its heights are those of the mission: z counts from their zero.

    Attributes:
        flat_m: The height of flat ground [m].
        terrain: The file of a terrain, relative to the mission's: GeoTIFF (``.tif``) or ESRI's
            ASCII grid (``.asc``), in metres of the mission's own frame. In Python a `Terrain` may
            stand here.
        nodata: What to make of places whose height nobody knows: ``blocked``, so that nothing flies
            over them, or ``free``: then neither ground nor height above ground is known there. What
            lies beyond a terrain's edge is unknown as well.
        origin_m: What of the file's own coordinates is the mission's 0, 0, ``[x, y]`` [m].
    """

    flat_m: Coordinate | None = None
    terrain: TerrainFile | None = None
    nodata: NoData = "blocked"
    origin_m: Origin2 = (0.0, 0.0)

    def heights_at(self, points: ArrayLike) -> Floats:
        """How high the ground is at places.

        Args:
            points: x, y [m], shape (..., 2).

        Returns:
            Heights [m], shape (...); NaN where nothing is known of the ground.

        >>> GroundSpec(flat_m=3).heights_at([(0, 0), (5, 5)])
        array([3., 3.])
        """
        if self.terrain is not None:
            return self.terrain.height_at(points)
        assert self.flat_m is not None
        return np.full(np.shape(points)[:-1], self.flat_m)
