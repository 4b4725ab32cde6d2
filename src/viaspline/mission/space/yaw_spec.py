"""Where a robot in space looks.

Tested through ``mission/space/test_spatial_keys``.
"""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from viaspline.mission.annotations import Expects
from viaspline.mission.fields import Heading, Point3
from viaspline.mission.value import OneOf


class FixedYaw(
    OneOf,
    expected="{to: [x, y, z]} or {fixed_deg: 90}",
    exactly_one=("to", "fixed_deg"),
    examples=(
        {"to": [20, 10, 3]},
        {"fixed_deg": 90},
    ),
):
    """Somewhere else than along the path.

    Attributes:
        to: A place that it looks at all the time, ``[x, y, z]`` [m].
        fixed_deg: A heading that it keeps [deg, anticlockwise from x].
    """

    to: Point3 | None = None
    fixed_deg: Heading | None = None


Yaw: TypeAlias = Annotated[
    Literal["along"] | FixedYaw, Expects("along, {to: [x, y, z]} or {fixed_deg: 90}")
]
