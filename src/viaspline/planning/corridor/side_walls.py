"""Sides that are asked for in a corridor: thin walls from an obstacle to the edge.

In a corridor an obstacle is passed on a side as seen along the corridor, not along the straight
line between two via points. A wall across the side that is forbidden leaves the other one to the
search for a first line, to the line of least curvature and to the proof, and none of them needs to
know of sides.

"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.shapes.capsule import Capsule
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.mission.strip import Strip
from viaspline.planning.routing.asked_sides import sided
from viaspline.world.world import World

WALL_RADIUS_M = 1e-6  # so thin that what is kept from it is what is kept from the obstacle
BEYOND_EDGE_M = 1e-3  # that a wall reaches


def with_side_walls(world: World, strip: Strip) -> World:
    """The world with a wall across the forbidden side of everything that has one.

    The walls come after all obstacles; who had a side has none here.

    Args:
        world: The known world.
        strip: The corridor.
    """
    indices = sided(world)
    if not indices.size:
        return world
    free = {"pass_on": None, "never_pass_on": None}
    obstacles = [
        obstacle if obstacle.forced_side is None else obstacle.model_copy(update=free)
        for obstacle in world.obstacles
    ]
    return World(
        [*obstacles, *_walls(world, strip, indices.tolist())],
        bounds=world.bounds, fences=world.fences, corridor=world.corridor,
    )  # fmt: skip


def _walls(world: World, strip: Strip, indices: list[int]) -> Iterator[Obstacle]:
    for i in indices:
        obstacle = world.obstacles[i]
        ring = obstacle.ring
        assert ring is not None  # a map of squares has no sides
        heart: Floats = ring.vertices.mean(axis=0)
        if world.distances_to(i, heart[None])[0] >= 0.0:  # a bent one
            heart = ring.vertices[0]
        row = strip.nearest_row(heart)
        edge = strip.right[row] if obstacle.forced_side == "left" else strip.left[row]
        out = edge - (strip.left[row] if obstacle.forced_side == "left" else strip.right[row])
        out = out / np.hypot(*out)
        reach = float((edge - heart) @ out) + BEYOND_EDGE_M
        if reach > 0.0:  # else it stands beyond the edge, and nothing passes there
            tip = heart + reach * out
            wall = Capsule(
                from_=(float(heart[0]), float(heart[1])), to=(float(tip[0]), float(tip[1])),
                radius=WALL_RADIUS_M,
            )  # fmt: skip
            forbidden = "right" if obstacle.forced_side == "left" else "left"
            yield Obstacle(capsule=wall, name=f"the {forbidden} side of {world.name(i)}")
