"""Scans and maps of ROS as the navigator takes them.

Tested through ``links/ros/test_ros_bridge``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from viaspline.errors import GeometryError
from viaspline.links.ros.frame_tree import PlanarPose, pose_from
from viaspline.maps.grid import Grid
from viaspline.robot.perception.lidar import Scan

OCCUPIED: Final = 65
"""From here on a cell of a map is occupied [%], as in Nav2."""


def scan_from(message: Mapping[str, Any], at: PlanarPose) -> Scan | tuple[()]:
    """What a LaserScan shows from where the sensor was; nothing where it has no beam.

    Beams that tell nothing (too near, NaN) become NaN; angles that run clockwise are turned round.
    """
    ranges = np.asarray(message["ranges"], np.float64)
    first, step = float(message["angle_min"]), float(message["angle_increment"])
    if not ranges.size or not all(math.isfinite(value) for value in (first, step)):
        return ()
    if step < 0.0:
        first, step, ranges = first + step * (ranges.size - 1), -step, ranges[::-1]
    step = step or 1e-3
    most = math.floor((math.tau + 1e-9) / step) + 1  # beams of one turn
    ranges = np.where(ranges < max(float(message["range_min"]), 1e-6), np.nan, ranges)[-most:]
    reach = float(message["range_max"])
    return Scan((at.x, at.y), at.heading, first, step, reach, ranges)


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
