"""What a kind of obstacle that is no map says of itself.

Tested through ``mission/shapes/test_obstacle``.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import ClassVar, Protocol, Self

from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.unplaced_faults import Path, UnplacedFault


class Shape(Protocol):
    """A kind of obstacle: its outline, and what may be wrong with it.

    Attributes:
        EXAMPLE: One of its kind, as it stands in a mission file.
    """

    EXAMPLE: ClassVar[str]

    def ring(self) -> RoundedRing:
        """All places that it covers; of a kind that has heights, its outline in plan."""
        ...

    @classmethod
    def faults(cls, placed: Iterable[tuple[Path, Self]]) -> list[UnplacedFault]:
        """What its types let pass, but covers nothing that makes sense.

        Args:
            placed: All of the kind that a mission has, each with where it stands. They may be a
                million: a kind that can't be wrong doesn't look at them.
        """
        ...
