"""How near a robot's body comes to things along a path: a disc, or a polygon with its heading."""

from __future__ import annotations

import numpy as np

from viaspline.curve.footprint_conflicts import body_conflicts
from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.planning.checking.conflicts import CLEAR
from viaspline.planning.problem.requirements import Requirements
from viaspline.robot.navigation.progress import SAME_PLACE_M
from viaspline.world.world import World


def room_along(world: World, path: Path, along: Floats, requirements: Requirements) -> Floats:
    """The room on a path as that of its places, whatever the body's shape is [m], shape (n,).

    Of a polygon it is what lies between it and the nearest thing, and the radius of the largest
    disc in it: what is required of the path is kept where the room is as much. It is no less than
    that radius, however far the polygon gets into something.

    Args:
        world: What is near.
        path: What is driven.
        along: Distances along it [m], shape (n,).
        requirements: The body.

    Example:
        >>> from viaspline.mission.shapes.obstacle import Obstacle
        >>> world = World([Obstacle(circle={"center": (5, 0), "radius": 1})])
        >>> path = Path([[[0, 0], [3, 0], [6, 0], [9, 0]]], vias=[])
        >>> cart = Requirements(radius=0.5, clearance=0.1)
        >>> room_along(world, path, np.array([0.0, 1.0]), cart).tolist()
        [4.0, 3.0]
        >>> van = Requirements(
        ...     radius=0.5, clearance=0.1, footprint=((-1, -0.5), (2, -0.5), (2, 0.5), (-1, 0.5))
        ... )
        >>> room_along(world, path, np.array([0.0, 1.0]), van).tolist()
        [2.5, 1.5]
    """
    if requirements.footprint is None:
        room: Floats = world.distance(path.at_distance(along))
        return room
    u = np.asarray(path.parameter(along))
    headings = np.asarray(path.heading(u))
    gaps = world.body_distance(
        np.asarray(path.evaluate(u))[:, :2], headings, requirements.footprint
    )
    return requirements.radius + gaps


def clear_places(
    world: World, path: Path, start: float, along: Floats, footprint: Floats, gap: float
) -> int:
    """How many places of a path a polygon can take, from the first on, and keep a distance.

    It is proven for all of its motion up to there, its turns on the spot included.

    Args:
        world: What is near.
        path: What is driven.
        start: Where the robot is on it [m].
        along: Distances along it, in order [m], shape (n,).
        footprint: As from ``viaspline.world.outline`` [m], (k, 2).
        gap: Distance to keep between the body and everything [m].
    """
    ends = np.asarray(path.parameter(np.append(start, along)))
    first = float(ends[0])

    def is_clear(count: int) -> bool:
        if count == 0 or along[count - 1] - start <= SAME_PLACE_M:
            return True
        spans = path.section(first, float(ends[count])).spans
        return bool((body_conflicts(world.packed, spans, footprint, gap) == CLEAR).all())

    low, high = 0, len(along)
    if is_clear(high):
        return high
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if is_clear(middle) else (low, middle)
    return low
