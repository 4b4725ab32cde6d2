"""What is known of a world as ``nav_msgs/OccupancyGrid``."""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np

from viaspline.kernels.world.rasterize import rasterized
from viaspline.ros_messages.pose_message import pose
from viaspline.ros_messages.stamps import MAP_FRAME, header, stamp_of
from viaspline.world.world import World

FREE, OCCUPIED = 0, 100
CELL_M: Final = 0.05
"""Side of a cell where there is neither a map nor too much room [m]."""
MOST_CELLS: Final = 250_000

Box = tuple[float, float, float, float]


def cell_size(world: World, box: Box) -> float:
    """Side of the cells of a world's grid [m]: that of its finest map, where that isn't too fine.

    >>> cell_size(World(), (0.0, 0.0, 10.0, 10.0))
    0.05
    >>> cell_size(World(), (0.0, 0.0, 500.0, 500.0))
    1.0
    """
    sides = [one.grid.resolution for one in world.obstacles if one.grid is not None]
    area = (box[2] - box[0]) * (box[3] - box[1])
    return max(min(sides, default=CELL_M), math.sqrt(area / MOST_CELLS))


def occupancy(time: float, world: World, box: Box) -> dict[str, Any]:
    """A world as a message: a cell is occupied if something is nearer to its middle than its edge.

    Args:
        time: [s].
        world: What is known.
        box: What is shown of it: x_min, y_min, x_max, y_max [m].

    Example:
        >>> from viaspline.mission.shapes.obstacle import Obstacle
        >>> world = World([Obstacle(circle={"center": (1, 1), "radius": 0.2})])
        >>> message = occupancy(0.0, world, (0.0, 0.0, 2.0, 2.0))
        >>> message["info"]["width"], sorted(set(message["data"].tolist()))
        (40, [0, 100])
    """
    side = cell_size(world, box)
    width = max(1, math.ceil((box[2] - box[0]) / side - 1e-9))
    height = max(1, math.ceil((box[3] - box[1]) / side - 1e-9))
    none = np.empty((0, 0), np.uint8)
    cells = rasterized(world.packed, box[0], box[1], side, height, width, 0.5 * side, none)
    return {
        "header": header(time, MAP_FRAME),
        "info": {
            "map_load_time": stamp_of(time),
            "resolution": side,
            "width": width,
            "height": height,
            "origin": pose(box[:2], 0.0),
        },
        "data": np.where(cells, OCCUPIED, FREE).astype(np.int8).ravel(),
    }
