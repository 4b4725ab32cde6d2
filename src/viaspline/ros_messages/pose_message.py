"""Poses in the plane as messages ``geometry_msgs/Pose``, and back."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from viaspline.ros_messages.stamps import header


def point(at: Sequence[float]) -> dict[str, float]:
    """A place [m], shape (2,) or (3,), as a message.

    >>> point((1.0, 2.0))
    {'x': 1.0, 'y': 2.0, 'z': 0.0}
    """
    return {"x": float(at[0]), "y": float(at[1]), "z": float(at[2]) if len(at) > 2 else 0.0}


def quaternion(heading: float) -> dict[str, float]:
    """A heading, anticlockwise from x [rad], as a message.

    >>> quaternion(0.0)
    {'x': 0.0, 'y': 0.0, 'z': 0.0, 'w': 1.0}
    """
    return {"x": 0.0, "y": 0.0, "z": math.sin(0.5 * heading), "w": math.cos(0.5 * heading)}


def heading_of(rotation: Mapping[str, float]) -> float:
    """The heading of a rotation, anticlockwise from x [rad]; it needn't be of length 1.

    >>> heading_of(quaternion(2.5))
    2.5
    """
    x, y, z, w = (rotation[name] for name in "xyzw")
    return math.atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z)


def pose(at: Sequence[float], heading: float) -> dict[str, Any]:
    """A pose as a message.

    Args:
        at: Where [m], shape (2,) or (3,).
        heading: Anticlockwise from x [rad].

    >>> pose((1.0, 2.0), 0.0)["orientation"]["w"]
    1.0
    """
    return {"position": point(at), "orientation": quaternion(heading)}


def pose_stamped(time: float, frame: str, at: Sequence[float], heading: float) -> dict[str, Any]:
    """A pose in a frame at a time [s], as ``geometry_msgs/PoseStamped``.

    >>> pose_stamped(0.0, "map", (1.0, 2.0), 0.0)["header"]["frame_id"]
    'map'
    """
    return {"header": header(time, frame), "pose": pose(at, heading)}
