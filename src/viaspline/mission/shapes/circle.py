"""A disc."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from viaspline.mission.fields import FAR, Point2, Positive, Value
from viaspline.mission.shapes.rounded_ring import RoundedRing


class Circle(Value):
    """A disc.

    Attributes:
        center: Its middle, ``[x, y]`` [m].
        radius: Its radius [m].
    """

    center: Point2
    radius: Annotated[Positive, Field(le=FAR)]

    def ring(self) -> RoundedRing:
        """One vertex with a radius."""
        return RoundedRing((((self.center[0], self.center[1]),),), self.radius)
