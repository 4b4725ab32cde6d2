"""Obstacles grown by a margin: what a path keeps away from that is to keep more than it must."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

from viaspline.kernels.arrays import Floats
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.world.world import World


class GrownObstacle(Obstacle):
    """A rounded ring with a larger radius.

    Attributes:
        margin: By how much it is grown [m].
    """

    margin: float = 0.0

    @cached_property
    def ring(self) -> RoundedRing | None:
        """Its shape as a rounded ring."""
        for _, shape in self.shapes():
            ring = shape.ring()
            return replace(ring, radius=ring.radius + self.margin)
        return None


def grown_world(world: World, margins: Floats) -> World:
    """A world in which every obstacle is grown by its margin.

    Args:
        world: The world; bounds, fences and maps stay as they are.
        margins: For each obstacle [m], (n,).

    Returns:
        A world of obstacles by the same names in the same order.

    Example:
        >>> import numpy as np
        >>> discs = [Obstacle(circle={"center": (x, 0), "radius": 1}) for x in (0, 10)]
        >>> grown_world(World(discs), np.array([0.5, 0.0])).distance([(3, 0), (7, 0)])
        array([1.5, 2. ])
    """
    return World(
        (_grown(one, by) for one, by in zip(world.obstacles, margins.tolist(), strict=True)),
        bounds=world.bounds,
        fences=world.fences,
        corridor=world.corridor,
    )


def _grown(obstacle: Obstacle, margin: float) -> Obstacle:
    if margin <= 0.0 or obstacle.grid is not None:
        return obstacle
    keys = {name: getattr(obstacle, name) for name in obstacle.model_fields_set}
    return GrownObstacle.model_construct(**keys, margin=margin)
