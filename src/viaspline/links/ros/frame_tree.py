"""Where frames are in each other, as tf tells it; in the plane."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from viaspline.ros_messages.pose_message import heading_of


class PlanarPose(NamedTuple):
    """A pose in a frame, or where a frame is in another: x, y [m] and heading [rad].

    >>> PlanarPose(1.0, 0.0, math.pi / 2).then(PlanarPose(2.0, 0.0, 0.0)).y
    2.0
    """

    x: float
    y: float
    heading: float

    def then(self, other: PlanarPose) -> PlanarPose:
        """The pose of what is at another pose in the frame that is at this one."""
        c, s = math.cos(self.heading), math.sin(self.heading)
        x, y = self.x + c * other.x - s * other.y, self.y + s * other.x + c * other.y
        return PlanarPose(x, y, self.heading + other.heading)

    @property
    def inverse(self) -> PlanarPose:
        """Where the frame in which this pose is given is, seen from the pose."""
        c, s = math.cos(self.heading), math.sin(self.heading)
        return PlanarPose(-c * self.x - s * self.y, s * self.x - c * self.y, -self.heading)


SAME = PlanarPose(0.0, 0.0, 0.0)


def pose_from(message: Mapping[str, Any]) -> PlanarPose:
    """The pose of a message ``geometry_msgs/Pose``."""
    at = message["position"]
    return PlanarPose(float(at["x"]), float(at["y"]), heading_of(message["orientation"]))


@dataclass(frozen=True)
class FrameTree:
    """What tf has told so far: the parent of every frame, and where the frame is in it.

    >>> tree = FrameTree().having("map", "odom", PlanarPose(1.0, 0.0, 0.0))
    >>> tree = tree.having("odom", "base_link", PlanarPose(2.0, 0.0, 0.0))
    >>> tree.pose("base_link", "map")
    PlanarPose(x=3.0, y=0.0, heading=0.0)
    >>> tree.pose("laser", "map") is None
    True
    """

    parents: Mapping[str, tuple[str, PlanarPose]] = field(default_factory=dict)

    def having(self, parent: str, child: str, pose: PlanarPose) -> FrameTree:
        """The tree with a frame where it is now."""
        if not all(math.isfinite(value) for value in pose):
            return self
        return FrameTree({**self.parents, _plain(child): (_plain(parent), pose)})

    def told(self, message: Mapping[str, Any]) -> FrameTree:
        """The tree after a message ``tf2_msgs/TFMessage``."""
        parents = dict(self.parents)  # once: a domain may be full of robots
        for one in message["transforms"]:
            moved, turned = one["transform"]["translation"], one["transform"]["rotation"]
            pose = PlanarPose(float(moved["x"]), float(moved["y"]), heading_of(turned))
            if all(math.isfinite(value) for value in pose):
                parent, child = one["header"]["frame_id"], one["child_frame_id"]
                parents[_plain(child)] = _plain(parent), pose
        return FrameTree(parents)

    def pose(self, frame: str, within: str) -> PlanarPose | None:
        """Where a frame is in another; None if they never connect."""
        ours, theirs = self._way_up(_plain(frame)), self._way_up(_plain(within))
        for name, pose in ours.items():
            if name in theirs:
                return theirs[name].inverse.then(pose)
        return None

    def _way_up(self, frame: str) -> dict[str, PlanarPose]:
        """The frame in itself, in its parent and so on; a circle of frames ends where it began."""
        found = {frame: SAME}
        name = frame
        while name in self.parents:
            parent, pose = self.parents[name]
            if parent in found:
                break
            found[parent] = pose.then(found[name])
            name = parent
        return found


def _plain(frame: str) -> str:
    return frame.removeprefix("/")
