"""Where a straight line comes too close to something."""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.routing.line_runs import line_runs
from viaspline.world.world import World

FINEST = 0.125  # piece of the line that is not looked into any further, in required distances


def blocked_runs(world: World, start: Floats, goal: Floats, required: float) -> Floats:
    """The pieces of a straight line that come too close to something.

    Pieces are halved until their middle says that all of one is free or blocked, which it does
    where its distance differs from what is required by more than half their length, or until they
    are too short to matter; those count as blocked.

    Args:
        world: What to keep clear of.
        start: Where the line begins [m], (2,).
        goal: Where it ends [m], (2,).
        required: Distance to keep [m], more than 0.

    Returns:
        Distances from its start between which it is blocked [m], (k, 2), in order.

    Example:
        >>> from viaspline.mission.shapes.obstacle import Obstacle
        >>> disc = Obstacle(circle={"center": (50, 0), "radius": 4})
        >>> ends = np.array(((0.0, 0.0), (100.0, 0.0)))
        >>> blocked_runs(World([disc]), *ends, 1.0).round().tolist()
        [[45.0, 55.0]]
    """
    length = float(np.hypot(*(goal - start)))
    if length == 0.0:
        return np.empty((0, 2))
    along, finest = (goal - start) / length, FINEST * required
    found: Floats = line_runs(world.packed, start, along, length, required, finest)
    return found
