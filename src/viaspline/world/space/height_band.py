"""In which heights a robot stays."""

from __future__ import annotations

import math
from dataclasses import dataclass

from viaspline.errors import GeometryError
from viaspline.handed_in import number_from


@dataclass(frozen=True, slots=True)
class HeightBand:
    """Limits of the height of a robot's reference point; each may be absent.

    Attributes:
        lowest: Least height [m]; -inf for none.
        highest: Greatest height [m]; inf for none.
        least_above_ground: Least height above the ground below [m]; -inf for none.
        most_above_ground: Greatest height above the ground below [m]; inf for none.

    Raises:
        GeometryError: A lower limit isn't below the upper one.

    >>> HeightBand(highest=120.0, least_above_ground=5.0).numbers
    (-inf, 120.0, 5.0, inf)
    """

    lowest: float = -math.inf
    highest: float = math.inf
    least_above_ground: float = -math.inf
    most_above_ground: float = math.inf

    def __post_init__(self) -> None:
        for name in self.__slots__:
            object.__setattr__(self, name, number_from(name, getattr(self, name)))
        for low, high in (("lowest", "highest"), ("least_above_ground", "most_above_ground")):
            least, most = getattr(self, low), getattr(self, high)
            if not least < most:
                raise GeometryError(f"{low} {least} isn't below {high} {most}; swap them")

    @property
    def numbers(self) -> tuple[float, float, float, float]:
        """As kernels take them: see ``PackedSpace.height_limits``."""
        return self.lowest, self.highest, self.least_above_ground, self.most_above_ground

    @property
    def knows_ground(self) -> bool:
        """Whether any of the limits is one above the ground."""
        return self.least_above_ground > -math.inf or self.most_above_ground < math.inf
