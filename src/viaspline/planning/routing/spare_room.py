"""How much more than required a path may keep from each obstacle without closing a way.

Tested through ``planning/test_roomy_path``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.planning.routing.gap_links import ConvexPieces, links_among
from viaspline.world.world import World

SHARE_USED = 0.9  # of the room to spare; a curve needs some of it


def spare_room(world: World, places: Floats, required: float, most: float) -> Floats:
    """By how much each obstacle may be grown so that gaps stay open, and places free [m], (n,).

    A gap through which the robot fits is shared by both sides of it. What stands too close
    together to pass between doesn't count, nor do gaps in one obstacle.

    Args:
        world: A world without maps.
        places: Via points [m], (k, 2).
        required: Distance that the path keeps anyway [m].
        most: The most that is of use [m].

    Example:
        >>> from viaspline.mission.shapes.obstacle import Obstacle
        >>> world = World([Obstacle(circle={"center": (x, 0), "radius": 1}) for x in (0, 5, 50)])
        >>> spare_room(world, np.array([[25.0, 0.0]]), required=1.0, most=2.0)
        array([0.45, 0.45, 2.  ])
    """
    room = np.full(len(world), most)
    for index in range(len(world)):
        left = float(world.distances_to(index, places).min()) - required
        room[index] = min(most, max(SHARE_USED * left, 0.0))
    pieces = ConvexPieces.of(world)
    links = links_among(pieces, 2.0 * (required + most))
    owners = pieces.owners[links.pairs]
    spare = links.widths - 2.0 * required
    passed = (owners[:, 0] != owners[:, 1]) & (spare >= 0.0)
    for (one, other), width in zip(owners[passed].tolist(), spare[passed].tolist(), strict=True):
        is_shared = one >= 0 and other >= 0
        for owner in (one, other):
            if owner >= 0:
                share = 0.5 * width if is_shared else width
                room[owner] = min(room[owner], SHARE_USED * share)
    return room
