"""A box with upright sides, which may be turned in plan.

Tested through ``mission/shapes/test_solid_shapes``.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import ClassVar, Final, Self

from viaspline.mission.fields import Heading, Point3
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import Prism
from viaspline.mission.unplaced_faults import Path, UnplacedFault, number
from viaspline.mission.value import Value

BOX_WORDS: Final = "{min: [x, y, z], max: [x, y, z]}"


class Box(
    Value,
    expected=BOX_WORDS,
    examples=({"min": [0, 0, 0], "max": [4, 2, 9], "yaw_deg": 30},),
):
    """All places between two corners, turned about the upright line through its middle.

    Attributes:
        min: The corner of its least coordinates before it is turned, ``[x, y, z]`` [m].
        max: The corner of its greatest, ``[x, y, z]`` [m].
        yaw_deg: Where its first side points when it is turned [deg, anticlockwise from x].
    """

    EXAMPLE: ClassVar[str] = f"box: {BOX_WORDS}"

    min: Point3
    max: Point3
    yaw_deg: Heading = 0.0

    def ring(self) -> RoundedRing:
        """Its outline in plan: four corners, anticlockwise.

        >>> Box(min=(0, 0, 0), max=(4, 2, 9), yaw_deg=90).ring().box
        (1.0, -1.0, 3.0, 3.0)
        """
        (x0, y0, _), (x1, y1, _) = self.min, self.max
        x, y, a, b = 0.5 * (x0 + x1), 0.5 * (y0 + y1), 0.5 * (x1 - x0), 0.5 * (y1 - y0)
        cosine, sine = _turn(self.yaw_deg)
        corners = ((-a, -b), (a, -b), (a, b), (-a, b))
        turned = [(x + cosine * u - sine * v, y + sine * u + cosine * v) for u, v in corners]
        return RoundedRing((tuple(turned),))

    def solid(self) -> Prism:
        """The prism over its outline."""
        return Prism(self.ring(), self.min[2], self.max[2])

    @classmethod
    def faults(cls, placed: Iterable[tuple[Path, Self]]) -> list[UnplacedFault]:
        """Those that have no inside.

        >>> [fault] = Box.faults([(("box",), Box(min=(0, 0, 5), max=(1, 1, 3)))])
        >>> fault.problem
        'z of min is 5, not less than z of max, 3'
        """
        return [
            UnplacedFault(
                (*path, "max"),
                f"{axis} of min is {number(low, 6)}, not less than {axis} of max, "
                f"{number(high, 6)}",
                "min has the least coordinates of the box, max the greatest",
            )
            for path, box in placed
            for axis, low, high in zip("xyz", box.min, box.max, strict=True)
            if low >= high
        ]


def _turn(degrees: float) -> tuple[float, float]:
    """Cosine and sine; exact for quarter turns."""
    quarters = degrees / 90.0
    if quarters == round(quarters):
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[round(quarters) % 4]
    angle = math.radians(degrees)
    return math.cos(angle), math.sin(angle)
