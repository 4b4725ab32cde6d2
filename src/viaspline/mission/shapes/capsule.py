"""A capsule: a pipe, a hedge, a cable on the ground.

Tested through ``mission/shapes/test_obstacle``.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, ClassVar, Final, Self

from pydantic import ConfigDict, Field

from viaspline.mission.fields import Length, Point2
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.mission.unplaced_faults import Path, UnplacedFault
from viaspline.mission.value import Value

CAPSULE_WORDS: Final = "{from: [x, y], to: [x, y], radius: 0.3}"


class Capsule(
    Value,
    expected=CAPSULE_WORDS,
):
    """Everything within a radius of a straight line.

    Attributes:
        from_: Where the line begins, ``[x, y]`` [m]; ``from`` in a file.
        to: Where it ends, ``[x, y]`` [m].
        radius: How far it reaches to all sides of the line [m].
    """

    model_config = ConfigDict(
        validate_by_alias=True, validate_by_name=True, serialize_by_alias=True
    )

    EXAMPLE: ClassVar[str] = f"capsule: {CAPSULE_WORDS}"

    from_: Annotated[Point2, Field(alias="from")]
    to: Point2
    radius: Length

    def ring(self) -> RoundedRing:
        """Two vertices with a radius.

        >>> Capsule(from_=(0, 0), to=(4, 0), radius=1).ring().box
        (-1.0, -1.0, 5.0, 1.0)
        """
        return RoundedRing(((self.from_, self.to),), self.radius)

    @classmethod
    def faults(cls, placed: Iterable[tuple[Path, Self]]) -> list[UnplacedFault]:
        """Those that begin where they end.

        >>> [fault] = Capsule.faults([(("capsule",), Capsule(from_=(1, 2), to=(1, 2), radius=1))])
        >>> fault.remedy
        'move one of them, or give circle: {center: [1, 2], radius: 1}'
        """
        return [
            UnplacedFault(
                (*path, "to"),
                "the capsule ends where it begins",
                f"move one of them, or give circle: {{center: [{x:g}, {y:g}], "
                f"radius: {capsule.radius:g}}}",
            )
            for path, capsule in placed
            for x, y in [capsule.from_]
            if capsule.from_ == capsule.to
        ]
