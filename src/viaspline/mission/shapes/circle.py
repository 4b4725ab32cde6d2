"""A disc.

Tested through ``mission/shapes/test_obstacle``.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import ClassVar, Final, Self

from viaspline.mission import others_words
from viaspline.mission.fields import Length, Point2
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.unplaced_faults import Path, UnplacedFault
from viaspline.mission.value import Value

CIRCLE_WORDS: Final = "{center: [x, y], radius: 5}"


class Circle(
    Value,
    foreign=others_words.CIRCLE,
    expected=CIRCLE_WORDS,
    examples=({"center": [20, 10], "radius": 3},),
):
    """A disc.

    Attributes:
        center: Its middle, ``[x, y]`` [m].
        radius: Its radius [m].
    """

    EXAMPLE: ClassVar[str] = f"circle: {CIRCLE_WORDS}"

    center: Point2
    radius: Length

    def ring(self) -> RoundedRing:
        """One vertex with a radius."""
        return RoundedRing((((self.center[0], self.center[1]),),), self.radius)

    @classmethod
    def faults(cls, placed: Iterable[tuple[Path, Self]]) -> list[UnplacedFault]:
        """None: a centre and a positive radius are all it takes."""
        return []
