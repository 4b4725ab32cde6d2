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

NEAR = 2.0
"""Of the body and its clearance: what a leg's straight line comes so near to, it has to pass."""


@dataclass(frozen=True, eq=False)
class AskedPass:
    """One obstacle with the sides on which it may be passed.

    Attributes:
        solid: The obstacle.
        allowed: On which sides.
    """

    solid: Solid
    allowed: tuple[PassSide, ...]

    @classmethod
    def of(cls, obstacle: Obstacle) -> AskedPass | None:
        """What is asked of an obstacle; None if nothing is."""
        if obstacle.pass_on is not None:
            return cls(obstacle.solid(), (obstacle.pass_on,))
        if obstacle.never_pass_on is not None:
            return cls(obstacle.solid(), without([obstacle.never_pass_on]))
        return None


def asked_passes(mission: Mission) -> tuple[AskedPass, ...]:
    """Of all obstacles that stand in the mission's known world."""
    found = (AskedPass.of(obstacle) for obstacle in mission.world.standing)
    return tuple(one for one in found if one is not None)


def gates_of_leg(asked: Sequence[AskedPass], first: Floats, last: Floats, body: float) -> Floats:
    """The gates that a leg has to pass rightly.

    An obstacle counts on a leg whose straight line, in plan, comes nearer to it than twice the
    body and its clearance.

    Args:
        asked: What is asked.
        first: Where the leg begins [m], (3,).
        last: Where it ends [m], (3,).
        body: Radius of the body and clearance together [m].

    Returns:
        Shape (g, 8).
    """
    line = shapely.LineString([first[:2], last[:2]])
    near = [
        gate(one.solid, first, last, one.allowed)
        for one in asked
        if shapely.distance(line, _outline(one.solid)) <= NEAR * body
    ]
    return np.concatenate([NO_GATES, *near])


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
