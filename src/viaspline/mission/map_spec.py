"""Obstacles that have a file of their own, as a mission asks for them.

Tested through ``mission/test_resolve_files``.
"""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import BeforeValidator, Field

from viaspline.maps.grid import LARGEST_CELL_M
from viaspline.maps.reading import Unknown
from viaspline.mission.annotations import Expects
from viaspline.mission.fields import METRES, MIN_LENGTH_M, Heights, Name, Number, as_text
from viaspline.mission.shapes.obstacle import SpatialSide
from viaspline.mission.value import Value

CellSize: TypeAlias = Annotated[Number, METRES, Field(ge=MIN_LENGTH_M, le=LARGEST_CELL_M)]


class MapSpec(
    Value,
    examples=(
        {"map": "maps/depot.yaml", "unknown": "free", "name": "depot"},
        {"map": "site.geojson", "pass_on": "left", "height_m": [0, 12]},
        {"map": "site.svg", "resolution_m": 0.5, "never_pass_on": "right"},
    ),
):
    """Obstacles that have a file of their own, as a mission asks for them.

    Attributes:
        map: The file, relative to the mission's: a map of squares (ROS's map_server YAML,
            MovingAI's ``.map``) becomes one obstacle, and if ``bounds`` aren't given, the robot
            stays inside of it; each polygon of a drawing (``.svg``) or of GeoJSON becomes one.
        unknown: What to make of squares that nobody has seen. None: they are blocked.
        resolution_m: Side of a square of a MovingAI map, or length of a unit of a drawing [m].
            None: 1 m.
        name: What it is called in reports and errors; several polygons are numbered.
        pass_on: Go past each of its polygons on this side only.
        never_pass_on: The side that is forbidden.
        height_m: Floor and roof of all of it in space, ``[low, high]`` [m]. None: every height.
    """

    map: Annotated[Name, BeforeValidator(as_text), Expects("the path of a map such as depot.yaml")]
    unknown: Unknown | None = None
    resolution_m: CellSize | None = None
    name: Name | None = None
    pass_on: SpatialSide | None = None
    never_pass_on: SpatialSide | None = None
    height_m: Heights | None = None
