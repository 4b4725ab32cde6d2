"""Maps of ROS as missions have them.

Tested through ``links/ros/test_ros_bridge``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from viaspline.errors import GeometryError
from viaspline.links.ros.frame_tree import pose_from
from viaspline.maps.grid import Grid

OCCUPIED: Final = 65
"""From here on a cell of a map is occupied [%], as in Nav2."""


def grid_from(message: Mapping[str, Any]) -> Grid:
    """The squares that a map blocks: occupied ones, and those of which nothing is known.

    Raises:
        GeometryError: Its numbers contradict each other.
    """
    info = message["info"]
    cells = np.asarray(message["data"], np.int16)
    size = int(info["height"]), int(info["width"])
    if cells.size != size[0] * size[1] or not cells.size:
        raise GeometryError(f"the map has {cells.size} cells and says {size[1]} x {size[0]}")
    origin = pose_from(info["origin"])
    blocked = ((cells >= OCCUPIED) | (cells < 0)).reshape(size)
    return Grid(blocked, float(info["resolution"]), (origin.x, origin.y, origin.heading))
