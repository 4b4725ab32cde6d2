"""The band of heights in which a robot may fly.

Tested through ``mission/space/test_spatial_keys``.
"""

from __future__ import annotations

from typing import Literal, TypeAlias

from viaspline.mission.fields import Coordinate
from viaspline.mission.value import Value

Above: TypeAlias = Literal["home", "ground", "amsl"]
"""What heights are counted from: home, the ground below, or where the ground's heights are 0."""


class AltitudeSpec(
    Value,
    expected="a mapping such as {min_m: 5, max_m: 120, above: home}",
    examples=({"min_m": 5, "max_m": 120, "above": "ground"},),
):
    """How low and how high the robot's reference point may be.

    Between take-off and landing it holds everywhere; on the vertical legs of these only the upper
    limit does.

    Attributes:
        min_m: The least height [m]. None: only what stands below limits it.
        max_m: The greatest height [m]. None: no limit.
        above: What heights are counted from: ``home``, the ground under the start; ``ground``, the
            ground under each place; ``amsl``, the zero of the ground's own heights.
    """

    min_m: Coordinate | None = None
    max_m: Coordinate | None = None
    above: Above = "home"

    @property
    def is_upside_down(self) -> bool:
        """Whether there is no height between its limits."""
        return self.min_m is not None and self.max_m is not None and self.min_m >= self.max_m
