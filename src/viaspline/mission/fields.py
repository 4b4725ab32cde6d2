"""What the fields of a mission are made of: numbers with units and limits, points, rings, names.

Tested through ``mission/test_model``.
"""

from __future__ import annotations

import os
from typing import Annotated, Any, Final, TypeAlias

from pydantic import AfterValidator, BeforeValidator, Field

from viaspline.mission.annotations import Expects, Unit

MAX_LENGTH_M: Final = 1e9
"""The farthest coordinate and the greatest length; beyond it a double loses the micrometre."""
MIN_LENGTH_M: Final = 1e-6
"""The least length of what has one."""
MAX_TURN_RADIUS_M: Final = 1e4
"""The widest turning circle; that of the largest ships is a fifth of it."""
SPEEDS_MPS: Final = (1e-4, 1e4)
"""From metres in hours to what nothing near the ground does."""
ACCELERATIONS_MPS2: Final = (1e-4, 1e6)
JERKS_MPS3: Final = (1e-4, 1e8)
ANGULAR_SPEEDS_DEGPS: Final = (1e-3, 1e6)
ANGULAR_ACCELERATIONS_DEGPS2: Final = (1e-3, 1e8)
MAX_DURATION_S: Final = 1e7
"""The longest stop, some four months."""
MIN_TIME_LIMIT_S: Final = 1e-3
"""The least time that something may take."""
MAX_HEADING_DEG: Final = 36_000.0
"""The farthest turned heading; a hundred times round lose no digit that matters."""

METRES: Final = Unit("m", "metres")
SECONDS: Final = Unit("s", "seconds")
DEGREES: Final = Unit("deg", "degrees")
HEADING_DEGREES: Final = Unit("deg, anticlockwise from x", "degrees, anticlockwise from x")
DEGREES_PER_SECOND: Final = Unit("deg/s", "degrees per second")
DEGREES_PER_SECOND2: Final = Unit("deg/s²", "degrees/s²")
METRES_PER_SECOND: Final = Unit("m/s", "metres per second")
METRES_PER_SECOND2: Final = Unit("m/s²", "m/s²")
METRES_PER_SECOND3: Final = Unit("m/s³", "m/s³")


def _within(limits: tuple[float, float]) -> Any:
    """A number's least and its greatest value."""
    return Field(ge=limits[0], le=limits[1])


Number: TypeAlias = Annotated[float, Field(strict=True, allow_inf_nan=False)]
NotNegative: TypeAlias = Annotated[Number, Field(ge=0)]

Coordinate: TypeAlias = Annotated[Number, METRES, Field(ge=-MAX_LENGTH_M, le=MAX_LENGTH_M)]
Length: TypeAlias = Annotated[Number, METRES, Field(ge=MIN_LENGTH_M, le=MAX_LENGTH_M)]
"""A length that something has [m]."""
TurnRadius: TypeAlias = Annotated[Number, METRES, Field(ge=MIN_LENGTH_M, le=MAX_TURN_RADIUS_M)]
"""The radius of a turning circle [m]."""
Distance: TypeAlias = Annotated[NotNegative, METRES, Field(le=MAX_LENGTH_M)]
"""A length that may be nothing [m]."""
Speed: TypeAlias = Annotated[Number, METRES_PER_SECOND, _within(SPEEDS_MPS)]
Acceleration: TypeAlias = Annotated[Number, METRES_PER_SECOND2, _within(ACCELERATIONS_MPS2)]
Jerk: TypeAlias = Annotated[Number, METRES_PER_SECOND3, _within(JERKS_MPS3)]
AngularSpeed: TypeAlias = Annotated[Number, DEGREES_PER_SECOND, _within(ANGULAR_SPEEDS_DEGPS)]
AngularAcceleration: TypeAlias = Annotated[
    Number, DEGREES_PER_SECOND2, _within(ANGULAR_ACCELERATIONS_DEGPS2)
]
SpeedNoise: TypeAlias = Annotated[NotNegative, METRES_PER_SECOND, Field(le=SPEEDS_MPS[1])]
AngularSpeedNoise: TypeAlias = Annotated[
    NotNegative, DEGREES_PER_SECOND, Field(le=ANGULAR_SPEEDS_DEGPS[1])
]
Duration: TypeAlias = Annotated[NotNegative, SECONDS, Field(le=MAX_DURATION_S)]
TimeLimit: TypeAlias = Annotated[Number, SECONDS, Field(ge=MIN_TIME_LIMIT_S, le=MAX_DURATION_S)]
"""How long something may take [s]."""
Heading: TypeAlias = Annotated[
    Number, HEADING_DEGREES, Field(ge=-MAX_HEADING_DEG, le=MAX_HEADING_DEG)
]

Name: TypeAlias = Annotated[str, Field(strict=True, min_length=1)]
Corners: TypeAlias = tuple[tuple[float, float], ...]
"""A polygon's corners [m]; no last one repeats the first."""


def plain(value: Any) -> Any:
    """Arrays as lists."""
    return value.tolist() if hasattr(value, "tolist") else value


def _opened(ring: Corners) -> Corners:
    """Drop a last point that repeats the first, as other formats write rings."""
    return ring[:-1] if len(ring) > 3 and ring[0] == ring[-1] else ring


def _on_earth(place: tuple[float, float]) -> tuple[float, float]:
    """Refuse what files have in which nobody has said where on earth they are."""
    if place == (0.0, 0.0):
        raise ValueError("[0, 0] means nowhere; give the latitude and longitude of the site")
    return place


def as_text(value: Any) -> Any:
    """Paths as texts."""
    return os.fspath(value) if isinstance(value, os.PathLike) else value


RING_WORDS: Final = "at least three points [[x, y], [x, y], [x, y]] in metres"

Point2: TypeAlias = Annotated[
    tuple[Coordinate, Coordinate], BeforeValidator(plain), Expects("[x, y] in metres")
]
Point: TypeAlias = Annotated[
    tuple[Coordinate, ...],
    Field(min_length=2, max_length=3),
    BeforeValidator(plain),
    Expects("[x, y] or [x, y, z] in metres"),
]
Point3: TypeAlias = Annotated[
    tuple[Coordinate, Coordinate, Coordinate],
    BeforeValidator(plain),
    Expects("[x, y, z] in metres"),
]
LatLonDeg: TypeAlias = Annotated[
    tuple[
        Annotated[Number, DEGREES, Field(ge=-90, le=90)],
        Annotated[Number, DEGREES, Field(ge=-180, le=180)],
    ],
    DEGREES,
    BeforeValidator(plain),
    AfterValidator(_on_earth),
    Expects("[latitude, longitude] in degrees such as [47.1, 8.5]"),
]
"""A place on earth [deg]."""
Heights: TypeAlias = Annotated[
    tuple[Coordinate, Coordinate],
    METRES,
    BeforeValidator(plain),
    Expects("[low, high] in metres"),
]
"""A floor and a roof [m]."""
Ring: TypeAlias = Annotated[
    tuple[Point2, ...],
    Field(min_length=3),
    BeforeValidator(plain),
    AfterValidator(_opened),
    Expects(RING_WORDS),
]
Rings: TypeAlias = Annotated[tuple[Ring, ...], Expects(f"a list of polygons, each {RING_WORDS}")]
