"""A gate: an upright rectangle that the path goes through, square to it.

Tested through ``mission/space/test_spatial_keys``.
"""

from __future__ import annotations

import math

from viaspline.mission.fields import Heading, Length, Point3
from viaspline.mission.value import Value


class GateSpec(
    Value,
    expected="{at: [x, y, z], facing_deg: 30, width_m: 2, height_m: 1.5}",
    examples=({"at": [20, 0, 5], "facing_deg": 30, "width_m": 3, "height_m": 2},),
):
    """An upright opening; the path goes through its middle, in the direction that it faces.

    The gate itself blocks nothing: its frame is an obstacle, if it has one. The whole body and its
    clearance have to fit in.

    Attributes:
        at: Its middle, ``[x, y, z]`` [m].
        facing_deg: The direction in which it is flown through [deg, anticlockwise from x].
        width_m: From side to side [m].
        height_m: From bottom to top [m].
    """

    at: Point3
    facing_deg: Heading
    width_m: Length
    height_m: Length

    @property
    def way(self) -> tuple[float, float]:
        """The level unit vector of the direction that it faces."""
        angle = math.radians(self.facing_deg)
        return math.cos(angle), math.sin(angle)
