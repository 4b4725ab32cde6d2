"""The world of a mission: how far it reaches, what stands in it, where to go slowly.

Tested through ``mission/test_resolve_files``.
"""

from __future__ import annotations

from functools import cached_property
from typing import Annotated, Any, TypeAlias

import numpy as np
from pydantic import BeforeValidator

from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.mission import others_words
from viaspline.mission.annotations import Expects
from viaspline.mission.fields import Coordinate, LatLonDeg, Name, Ring, Rings, Speed, plain
from viaspline.mission.map_spec import MapSpec
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.space.altitude_spec import AltitudeSpec
from viaspline.mission.space.ground_spec import GroundSpec
from viaspline.mission.standalone import Standalone
from viaspline.mission.tracks_spec import TracksSpec
from viaspline.mission.value import Value


def _resolved(value: Any) -> Any:
    """An obstacle as it is: maps and tracks have been read before, see ``resolve_files``."""
    return value


AnyObstacle: TypeAlias = Annotated[
    Obstacle, BeforeValidator(_resolved, json_schema_input_type=Obstacle | MapSpec | TracksSpec)
]
Obstacles: TypeAlias = Annotated[
    tuple[AnyObstacle, ...],
    Expects(
        "a list of obstacles such as - circle: {center: [x, y], radius: 5} or - map: depot.yaml"
    ),
]
Bounds4: TypeAlias = Annotated[
    tuple[Coordinate, Coordinate, Coordinate, Coordinate],
    BeforeValidator(plain),
    Expects("[x_min, y_min, x_max, y_max] in metres"),
]


class SpeedZone(
    Standalone,
    expected="a zone such as {polygon: [[x, y], ...], max_speed_mps: 0.5}",
    examples=(
        {"polygon": [[24, 16], [35, 16], [35, 24], [24, 24]], "max_speed_mps": 0.8, "name": "gate"},
    ),
):
    """An area in which the robot drives more slowly.

    Attributes:
        polygon: Its corners ``[[x, y], ...]`` [m].
        max_speed_mps: The greatest speed of the reference point inside of it [m/s].
        name: What it is called in reports and errors.

    Raises:
        MissionError: With every fault.

    >>> SpeedZone(polygon=[(0, 0), (4, 0), (4, 3)], max_speed_mps=0.5).max_speed_mps
    0.5
    """

    stands_at = ("world", "speed_zones", 0)

    polygon: Ring
    max_speed_mps: Speed
    name: Name | None = None

    @property
    def corners(self) -> Floats:
        """Its corners as an array [m], shape (n, 2).

        Raises:
            GeometryError: If the polygon is no area, e.g. as it crosses itself.
        """
        return np.array(self.sound_polygon, dtype=np.float64)

    @cached_property
    def sound_polygon(self) -> Ring:
        """Its corners, found to bound an area: once, for every time law asks.

        Raises:
            GeometryError: If they don't.
        """
        import shapely

        area = shapely.Polygon(self.polygon)
        if not area.is_valid or area.is_empty:
            reason = shapely.is_valid_reason(area)
            raise GeometryError(
                f"the polygon of speed zone '{self.name or ''}' isn't an area: {reason}"
            )
        return self.polygon


SpeedZones: TypeAlias = Annotated[
    tuple[SpeedZone, ...],
    Expects("a list of zones such as - {polygon: [[x, y], ...], max_speed_mps: 0.5}"),
]


class WorldSpec(
    Value,
    foreign=others_words.WORLD,
    examples=(
        {
            "bounds": [0, 0, 60, 40],
            "fences": [[[1, 1], [59, 1], [59, 39], [1, 39]]],
            "known": [{"circle": {"center": [20, 10], "radius": 3}}, {"map": "maps/depot.yaml"}],
            "unseen": [{"circle": {"center": [40, 12], "radius": 1}}],
            "speed_zones": [{"polygon": [[24, 16], [35, 16], [35, 24]], "max_speed_mps": 0.5}],
            "altitude": {"min_m": 5, "max_m": 120},
            "ground": {"flat_m": 400},
            "origin_deg": [47.3977, 8.5456],
        },
    ),
):
    """The known map, and what is there but not on the map.

    Attributes:
        bounds: ``x_min, y_min, x_max, y_max`` [m]; the robot stays inside. None: no bounds, or
            the edge of the maps of squares that are known.
        fences: Polygons that the robot stays inside of, every one (inclusion fences).
        known: Obstacles on the map.
        unseen: Obstacles that only the sensor finds.
        speed_zones: Areas with a lower speed; in space at every height.
        altitude: How low and how high the robot may fly. None: as it likes.
        ground: How high the ground is. None: there is no ground, and z = 0 is home.
        origin_deg: Where on earth the 0, 0 is, ``[latitude, longitude]`` [deg]: for formats that
            have these, such as QGroundControl's. None: nobody says.
    """

    bounds: Bounds4 | None = None
    fences: Rings = ()
    known: Obstacles = ()
    unseen: Obstacles = ()
    speed_zones: SpeedZones = ()
    altitude: AltitudeSpec | None = None
    ground: GroundSpec | None = None
    origin_deg: LatLonDeg | None = None

    @property
    def is_spatial(self) -> bool:
        """Whether anything in it says something of heights."""
        return (
            self.altitude is not None
            or self.ground is not None
            or any(obstacle.is_spatial for obstacle in self.known + self.unseen)
        )

    @property
    def standing(self) -> tuple[Obstacle, ...]:
        """What is on the map and doesn't move."""
        return tuple(obstacle for obstacle in self.known if obstacle.motion is None)

    @property
    def moving(self) -> tuple[Obstacle, ...]:
        """What moves as it is known to."""
        return tuple(obstacle for obstacle in self.known if obstacle.motion is not None)

    @property
    def unseen_standing(self) -> tuple[Obstacle, ...]:
        """What isn't on the map and doesn't move."""
        return tuple(obstacle for obstacle in self.unseen if obstacle.motion is None)

    @property
    def unseen_moving(self) -> tuple[Obstacle, ...]:
        """What moves, and nobody knows how."""
        return tuple(obstacle for obstacle in self.unseen if obstacle.motion is not None)
