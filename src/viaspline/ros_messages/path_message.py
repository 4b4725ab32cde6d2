"""A path as ``nav_msgs/Path``: points along it with headings."""

from __future__ import annotations

from typing import Any

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.ros_messages.pose_message import pose_stamped
from viaspline.ros_messages.stamps import MAP_FRAME, header


def path_points(time: float, points: Floats, headings: Floats, frame: str) -> dict[str, Any]:
    """Points [m], shape (n, 2) or (n, 3), with their headings [rad], shape (n,), as a message.

    >>> message = path_points(0.0, np.array([[0.0, 0.0], [1.0, 0.0]]), np.zeros(2), "map")
    >>> message["poses"][1]["pose"]["position"]["x"]
    1.0
    """
    rows = zip(points.tolist(), headings.tolist(), strict=True)
    poses = [pose_stamped(time, frame, at, heading) for at, heading in rows]
    return {"header": header(time, frame), "poses": poses}


def path_message(
    time: float, path: PiecewiseCubic, spacing: float, frame: str = MAP_FRAME
) -> dict[str, Any]:
    """A path as a message.

    Args:
        time: Of its header and of all poses, as Nav2 has it [s].
        path: The curve.
        spacing: The largest distance from one pose to the next, along the path [m].
        frame: In which it is.

    Raises:
        GeometryError: The spacing makes no sense.

    >>> from viaspline.curve.path import Path
    >>> straight = Path([[[0, 0], [1, 0], [2, 0], [3, 0]]], vias=[])
    >>> len(path_message(0.0, straight, 0.5)["poses"])
    7
    """
    u, _, points = path.sample(spacing)
    return path_points(time, points, np.atleast_1d(np.asarray(path.heading(u))), frame)
