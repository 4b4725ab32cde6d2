"""A strip that the path of a mission stays inside of.

Tested through ``mission/test_corridors``.
"""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import BeforeValidator, Field

from viaspline.mission.annotations import Expects
from viaspline.mission.fields import Coordinate, Distance, Length, Name, as_text, plain
from viaspline.mission.value import Value

Width: TypeAlias = Distance
CorridorRow: TypeAlias = Annotated[
    tuple[Coordinate, Coordinate, Width, Width],
    BeforeValidator(plain),
    Expects("a row [x, y, right, left] in metres"),
]
CorridorLine: TypeAlias = Annotated[
    tuple[CorridorRow, ...],
    Field(min_length=2),
    BeforeValidator(plain),
    Expects("rows [[x, y, right, left], ...] in metres"),
]


class Corridor(
    Value,
    expected="{left_m: 2, right_m: 2}, or {csv: track.csv} with rows x, y, right, left",
    examples=(
        {"left_m": 2, "right_m": 3},
        {"line": [[0, 0, 2, 2], [40, 0, 3, 2]]},
        {"csv": "track.csv"},
    ),
):
    """A strip that the path stays inside of: a lane, a race track, the strip along a pipeline.

    Widths alone are a bound: the path is laid through the route's points as ever. Along a line of
    its own the path is laid for least curvature, from the start through the via points to the goal
    or round again. An open strip goes straight on beyond its ends, by its larger width there;
    where a strip comes back to itself, the bound is what any part of it covers.

    Attributes:
        left_m: How far it reaches to the left of the polyline through the route's points [m].
        right_m: How far it reaches to the right of it [m].
        line: In place of both, the middle line with its widths: ``[[x, y, right, left], ...]``
            [m], in the direction of driving. Along a closed route it is closed.
        csv: In place of ``line``, a file with its rows, relative to the mission's. When the mission
            is read, ``line`` gets the rows and this becomes the file's absolute path.
    """

    left_m: Length | None = None
    right_m: Length | None = None
    line: CorridorLine | None = None
    csv: (
        Annotated[
            Name,
            BeforeValidator(as_text),
            Expects("the path of a file with rows x, y, right, left in metres"),
        ]
        | None
    ) = None
