"""A capsule: a pipe, a hedge; with heights a cable or a mast.

Tested through ``mission/shapes/test_obstacle``.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, ClassVar, Final, Self

from pydantic import ConfigDict, Field

from viaspline.mission.fields import Length, Point
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.shapes.solids import RoundedSegment
from viaspline.mission.unplaced_faults import Path, UnplacedFault
from viaspline.mission.value import Value

CAPSULE_WORDS: Final = "{from: [x, y], to: [x, y], radius: 0.3}"


class Capsule(
    Value,
    expected=CAPSULE_WORDS,
    examples=({"from": [0, 5], "to": [30, 5], "radius": 0.2},),
):
    """Everything within a radius of a straight line.

    Attributes:
        from_: Where the line begins, ``[x, y]`` or, in space, ``[x, y, z]`` [m]; ``from`` in a
            file.
        to: Where it ends, with as many coordinates [m].
        radius: How far it reaches to all sides of the line [m].
    """

    model_config = ConfigDict(
        validate_by_alias=True, validate_by_name=True, serialize_by_alias=True
    )

    EXAMPLE: ClassVar[str] = f"capsule: {CAPSULE_WORDS}"

    from_: Annotated[Point, Field(alias="from")]
    to: Point
    radius: Length

    @property
    def is_spatial(self) -> bool:
        """Whether its line has heights."""
        return len(self.from_) == 3

    def ring(self) -> RoundedRing:
        """Two vertices with a radius; of a line with heights, its outline in plan.

        >>> Capsule(from_=(0, 0), to=(4, 0), radius=1).ring().box
        (-1.0, -1.0, 5.0, 1.0)
        """
        first, last = (self.from_[0], self.from_[1]), (self.to[0], self.to[1])
        return RoundedRing(((first,) if first == last else (first, last),), self.radius)

    def solid(self) -> RoundedSegment:
        """Its line in space, which has to have heights.

        >>> Capsule(from_=(0, 0, 9), to=(4, 0, 8), radius=1).solid().box
        (-1.0, -1.0, 7.0, 5.0, 1.0, 10.0)
        """
        (x0, y0, z0), (x1, y1, z1) = self.from_, self.to
        return RoundedSegment((x0, y0, z0), (x1, y1, z1), self.radius)

    @classmethod
    def faults(cls, placed: Iterable[tuple[Path, Self]]) -> list[UnplacedFault]:
        """Those that begin where they end, or have one end in the plane and one in space.

        >>> [fault] = Capsule.faults([(("capsule",), Capsule(from_=(1, 2), to=(1, 2), radius=1))])
        >>> fault.remedy
        'move one of them, or give circle: {center: [1, 2], radius: 1}'
        """
        return [fault for path, capsule in placed for fault in _faults(path, capsule)]


def _faults(path: Path, capsule: Capsule) -> list[UnplacedFault]:
    if len(capsule.from_) != len(capsule.to):
        counts = f"has {len(capsule.to)} coordinates, but from has {len(capsule.from_)}"
        return [UnplacedFault((*path, "to"), counts, "give both of them 2, or both of them 3")]
    if capsule.from_ != capsule.to:
        return []
    kind = "ball" if capsule.is_spatial else "circle"
    center = ", ".join(f"{x:g}" for x in capsule.from_)
    remedy = f"move one of them, or give {kind}: {{center: [{center}], radius: {capsule.radius:g}}}"
    return [UnplacedFault((*path, "to"), "the capsule ends where it begins", remedy)]
