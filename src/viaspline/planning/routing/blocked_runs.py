"""Where a straight line comes too close to something."""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
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
    found = [np.empty((0, 2))]
    pieces = np.array([[0.0, length]]) if length > 0.0 else found[0]
    along = (goal - start) / max(length, 1e-300)
    while len(pieces):
        half = 0.5 * (pieces[:, 1] - pieces[:, 0])
        middle = 0.5 * (pieces[:, 0] + pieces[:, 1])
        room = world.distance(start + middle[:, None] * along) - required
        is_blocked = room < -half
        is_unsettled = ~is_blocked & (room < half)
        is_small = 2.0 * half <= FINEST * required
        found.append(pieces[is_blocked | (is_unsettled & is_small)])
        split = is_unsettled & ~is_small
        low, high, middle = pieces[split, 0], pieces[split, 1], middle[split]
        pieces = np.vstack((np.column_stack((low, middle)), np.column_stack((middle, high))))
    blocked = np.vstack(found)
    blocked = blocked[np.argsort(blocked[:, 0])]
    if not len(blocked):
        return blocked
    gaps = np.flatnonzero(blocked[1:, 0] > blocked[:-1, 1])
    first, last = np.append(0, gaps + 1), np.append(gaps, len(blocked) - 1)
    return np.column_stack((blocked[first, 0], blocked[last, 1]))
