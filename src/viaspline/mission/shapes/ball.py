"""A ball.

Tested through ``mission/shapes/test_solid_shapes``.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import ClassVar, Final, Self

from viaspline.mission.fields import Length, Point3
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import RoundedSegment
from viaspline.mission.unplaced_faults import Path, UnplacedFault
from viaspline.mission.value import Value

BALL_WORDS: Final = "{center: [x, y, z], radius: 5}"


class Ball(
    Value,
    expected=BALL_WORDS,
    examples=({"center": [20, 10, 30], "radius": 4},),
):
    """Everything within a radius of a place.

    Attributes:
        center: Its middle, ``[x, y, z]`` [m].
        radius: Its radius [m].
    """

    EXAMPLE: ClassVar[str] = f"ball: {BALL_WORDS}"

    center: Point3
    radius: Length

    def ring(self) -> RoundedRing:
        """Its outline in plan."""
        x, y, _ = self.center
        return RoundedRing((((x, y),),), self.radius)

    def solid(self) -> RoundedSegment:
        """A line without length, with a radius."""
        return RoundedSegment(self.center, self.center, self.radius)

    @classmethod
    def faults(cls, placed: Iterable[tuple[Path, Self]]) -> list[UnplacedFault]:
        """None: a centre and a positive radius are all it takes."""
        return []
