"""The sides on which a mission has obstacles passed, leg by leg."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from viaspline.kernels.arrays import Floats
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.shapes.solids import Prism, RoundedSegment, Solid
from viaspline.space.routing.pass_gates import NO_GATES, PassSide, gate, without
from viaspline.space.routing.search_room import SearchRoom
from viaspline.space.routing.shut_sides import is_shut

NEAR = 2.0
"""Of the body and its clearance: what a leg's straight line comes so near to, it has to pass."""


@dataclass(frozen=True, eq=False)
class AskedPass:
    """One obstacle with the sides on which it may be passed.

    Attributes:
        solid: The obstacle.
        allowed: On which sides.
        name: What it is called.
    """

    solid: Solid
    allowed: tuple[PassSide, ...]
    name: str = "an obstacle"

    @classmethod
    def of(cls, obstacle: Obstacle, name: str = "an obstacle") -> AskedPass | None:
        """What is asked of an obstacle; None if nothing is.

        Args:
            obstacle: It.
            name: What it is called.
        """
        if obstacle.pass_on is not None:
            return cls(obstacle.solid(), (obstacle.pass_on,), name)
        if obstacle.never_pass_on is not None:
            return cls(obstacle.solid(), without([obstacle.never_pass_on]), name)
        return None

    def is_shut(self, room: SearchRoom, first: Floats, last: Floats, required: float) -> bool:
        """Whether it is known that no way between two places passes it so; see ``shut_sides``.

        Args:
            room: Where.
            first: Where the way begins [m], (3,).
            last: Where it ends [m], (3,).
            required: Distance to be kept from everything [m].
        """
        rows = np.concatenate([gate(self.solid, first, last, [side]) for side in self.allowed])
        return len(rows) > 0 and all(
            is_shut(room, self.solid, row, (first, last), required) for row in rows
        )

    @property
    def words(self) -> str:
        """What is asked, in words.

        >>> from viaspline.mission.shapes.solids import RoundedSegment
        >>> mast = RoundedSegment((0.0, 0.0, 0.0), (0.0, 0.0, 9.0), 0.2)
        >>> AskedPass(mast, ("left", "right", "over"), "mast").words
        "'mast' left, right or over"
        """
        *others, last = self.allowed
        sides = f"{', '.join(others)} or {last}" if others else last
        return f"'{self.name}' {sides}"


def asked_passes(mission: Mission) -> tuple[AskedPass, ...]:
    """Of all obstacles that stand in the mission's known world."""
    found = (
        AskedPass.of(obstacle, obstacle.called(k))
        for k, obstacle in enumerate(mission.world.known)
        if obstacle.motion is None
    )
    return tuple(one for one in found if one is not None)


def passes_of_leg(
    asked: Sequence[AskedPass], first: Floats, last: Floats, body: float
) -> list[AskedPass]:
    """What counts on a leg: what its straight line, in plan, comes near to.

    Nearer than twice the body and its clearance.

    Args:
        asked: What is asked.
        first: Where the leg begins [m], (3,).
        last: Where it ends [m], (3,).
        body: Radius of the body and clearance together [m].
    """
    if not asked:
        return []
    line = shapely.LineString([first[:2], last[:2]])
    return [one for one in asked if shapely.distance(line, _outline(one.solid)) <= NEAR * body]


def gates_of_leg(asked: Sequence[AskedPass], first: Floats, last: Floats, body: float) -> Floats:
    """The gates that a leg has to pass rightly, of what counts on it.

    Args:
        asked: What is asked.
        first: Where the leg begins [m], (3,).
        last: Where it ends [m], (3,).
        body: Radius of the body and clearance together [m].

    Returns:
        Shape (g, 8).
    """
    near = passes_of_leg(asked, first, last, body)
    return np.concatenate([NO_GATES, *(gate(one.solid, first, last, one.allowed) for one in near)])


def _outline(solid: Solid) -> shapely.Geometry:
    """What a solid covers in plan."""
    if isinstance(solid, Prism):
        whole: shapely.Geometry = solid.ring.outline(16)
        return whole
    if isinstance(solid, RoundedSegment):
        first, last = solid.first[:2], solid.last[:2]
        core = shapely.Point(first) if first == last else shapely.LineString([first, last])
        return shapely.buffer(core, solid.radius)
    x0, y0, _, x1, y1, _ = solid.extent if hasattr(solid, "extent") else solid.box
    return shapely.box(x0, y0, x1, y1)
