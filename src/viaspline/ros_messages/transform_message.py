"""Where a frame is in another: ``tf2_msgs/TFMessage``."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

from viaspline.ros_messages.pose_message import point, quaternion
from viaspline.ros_messages.stamps import header


class FramePose(NamedTuple):
    """Where a frame is in its parent.

    Attributes:
        parent: The frame in which it is given.
        child: The frame.
        at: Its origin [m], shape (2,) or (3,).
        heading: Of its x, anticlockwise from that of the parent [rad].
    """

    parent: str
    child: str
    at: Sequence[float] = (0.0, 0.0)
    heading: float = 0.0


def transforms(time: float, frames: Iterable[FramePose]) -> dict[str, Any]:
    """Frames at a time [s], as a message.

    >>> message = transforms(0.5, [FramePose("map", "odom", (1.0, 0.0))])
    >>> message["transforms"][0]["transform"]["translation"]
    {'x': 1.0, 'y': 0.0, 'z': 0.0}
    """
    return {
        "transforms": [
            {
                "header": header(time, one.parent),
                "child_frame_id": one.child,
                "transform": {"translation": point(one.at), "rotation": quaternion(one.heading)},
            }
            for one in frames
        ]
    }
