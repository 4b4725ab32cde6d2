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

METRES: Final = Unit("m", "metres")
SECONDS: Final = Unit("s", "seconds")
DEGREES: Final = Unit("deg", "degrees")
HEADING_DEGREES: Final = Unit("deg, anticlockwise from x", "degrees, anticlockwise from x")
DEGREES_PER_SECOND: Final = Unit("deg/s", "degrees per second")
DEGREES_PER_SECOND2: Final = Unit("deg/s²", "degrees/s²")
METRES_PER_SECOND: Final = Unit("m/s", "metres per second")
METRES_PER_SECOND2: Final = Unit("m/s²", "m/s²")
METRES_PER_SECOND3: Final = Unit("m/s³", "m/s³")

Number: TypeAlias = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Positive: TypeAlias = Annotated[Number, Field(gt=0)]
NotNegative: TypeAlias = Annotated[Number, Field(ge=0)]

Coordinate: TypeAlias = Annotated[Number, METRES, Field(ge=-MAX_LENGTH_M, le=MAX_LENGTH_M)]
Length: TypeAlias = Annotated[Positive, METRES, Field(le=MAX_LENGTH_M)]
"""A length that something has [m]."""
Distance: TypeAlias = Annotated[NotNegative, METRES, Field(le=MAX_LENGTH_M)]
"""A length that may be nothing [m]."""
Speed: TypeAlias = Annotated[Positive, METRES_PER_SECOND]
Acceleration: TypeAlias = Annotated[Positive, METRES_PER_SECOND2]
Jerk: TypeAlias = Annotated[Positive, METRES_PER_SECOND3]
AngularSpeed: TypeAlias = Annotated[Positive, DEGREES_PER_SECOND]
AngularAcceleration: TypeAlias = Annotated[Positive, DEGREES_PER_SECOND2]
Duration: TypeAlias = Annotated[NotNegative, SECONDS]
Heading: TypeAlias = Annotated[Number, HEADING_DEGREES]

Name: TypeAlias = Annotated[str, Field(strict=True, min_length=1)]
Corners: TypeAlias = tuple[tuple[float, float], ...]
"""A polygon's corners [m]; no last one repeats the first."""


def plain(value: Any) -> Any:
    """Arrays as lists."""
    return value.tolist() if hasattr(value, "tolist") else value


def _opened(ring: Corners) -> Corners:
    """Drop a last point that repeats the first, as other formats write rings."""
    return ring[:-1] if len(ring) > 3 and ring[0] == ring[-1] else ring


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
Ring: TypeAlias = Annotated[
    tuple[Point2, ...],
    Field(min_length=3),
    BeforeValidator(plain),
    AfterValidator(_opened),
    Expects(RING_WORDS),
]
Rings: TypeAlias = Annotated[tuple[Ring, ...], Expects(f"a list of polygons, each {RING_WORDS}")]
