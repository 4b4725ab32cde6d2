"""A disc.

Tested through ``mission/test_model``.
"""

from __future__ import annotations

from viaspline.mission.fields import Length, Point2
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.value import Value


class Circle(
    Value,
    expected="{center: [x, y], radius: 5}",
):
    """A disc.

    Attributes:
        center: Its middle, ``[x, y]`` [m].
        radius: Its radius [m].
    """

    center: Point2
    radius: Length

    def ring(self) -> RoundedRing:
        """One vertex with a radius."""
        return RoundedRing((((self.center[0], self.center[1]),),), self.radius)
