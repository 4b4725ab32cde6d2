"""A disc."""

from __future__ import annotations

from typing import ClassVar

from viaspline.mission.fields import Length, Point2
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.value import Value


class Circle(Value):
    """A disc.

    Attributes:
        center: Its middle, ``[x, y]`` [m].
        radius: Its radius [m].
    """

    expected: ClassVar[str] = "{center: [x, y], radius: 5}"

    center: Point2
    radius: Length

    def ring(self) -> RoundedRing:
        """One vertex with a radius."""
        return RoundedRing((((self.center[0], self.center[1]),),), self.radius)
