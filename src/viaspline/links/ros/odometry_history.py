"""What a robot's odometry has said lately, and where the body was by it at a time.

Tested through ``links/ros/test_ros_bridge``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final, NamedTuple

from viaspline.links.ros.frame_tree import PlanarPose
from viaspline.ros_messages.odometry_message import state_from
from viaspline.ros_messages.stamps import seconds_of

RECENT: Final = 20
"""So many messages of odometry are kept."""
ONE_CLOCK_S: Final = 1.0
"""Stamps of a scan and of odometry that are farther apart aren't of one clock [s]."""


class HeardOfRobot(NamedTuple):
    """A message, and when it was heard [s]."""

    at: float
    message: Mapping[str, Any]

    @property
    def stamp(self) -> float:
        """The time of its header, by the robot's clock [s]."""
        return seconds_of(self.message["header"]["stamp"])

    @property
    def frame(self) -> str:
        """The frame of its header."""
        return str(self.message["header"]["frame_id"])


@dataclass(frozen=True, eq=False)
class OdometryHistory:
    """The last messages of odometry, in the order in which they were heard."""

    messages: tuple[HeardOfRobot, ...] = ()

    @property
    def last(self) -> HeardOfRobot | None:
        """The last that was heard."""
        return self.messages[-1] if self.messages else None

    def having(self, heard: HeardOfRobot) -> OdometryHistory:
        """It with one message more."""
        return OdometryHistory((*self.messages[1 - RECENT :], heard))

    def covers(self, scan: HeardOfRobot) -> bool:
        """Whether it is known where the body was when a scan was taken, and not only foretold.

        What is stamped by another clock, or by none, is taken to have been said at once.
        """
        last = self.last
        return last is not None and (last.stamp >= scan.stamp or not self._has_clock_of(scan))

    def base_at(self, scan: HeardOfRobot) -> PlanarPose:
        """Where the body was when a scan was taken: between two messages evenly on its way.

        Before the first and after the last message it is carried on as it went.
        """
        assert self.last is not None
        if not self._has_clock_of(scan):
            return carried(self.last, scan.at - self.last.at)
        before = max(
            (one for one in self.messages if one.stamp <= scan.stamp),
            key=lambda one: one.stamp, default=None,
        )  # fmt: skip
        after = min(
            (one for one in self.messages if one.stamp >= scan.stamp),
            key=lambda one: one.stamp, default=None,
        )  # fmt: skip
        if before is None or after is None:
            nearest = after if before is None else before
            assert nearest is not None
            return carried(nearest, scan.stamp - nearest.stamp)
        return _between(before, after, scan.stamp)

    def _has_clock_of(self, scan: HeardOfRobot) -> bool:
        if scan.stamp == 0.0:
            return False
        return min(abs(scan.stamp - one.stamp) for one in self.messages) <= ONE_CLOCK_S


def carried(odometry: HeardOfRobot, seconds: float) -> PlanarPose:
    """Where a body is by odometry a short time later or, below 0, before [s]."""
    state, turned = state_from(odometry.message), seconds * turning(odometry.message)
    way = math.hypot(state.speed, state.speed_across) * seconds
    course = state.heading + 0.5 * turned + math.atan2(state.speed_across, state.speed)
    x, y = state.position[:2]
    return PlanarPose(
        x + way * math.cos(course), y + way * math.sin(course), state.heading + turned
    )


def turning(odometry: Mapping[str, Any]) -> float:
    """How fast a body turns by a message of odometry [rad/s]."""
    return float(odometry["twist"]["twist"]["angular"]["z"])


def _between(before: HeardOfRobot, after: HeardOfRobot, stamp: float) -> PlanarPose:
    """The pose at a time between two messages: each is carried there, the nearer counts more."""
    lasts = after.stamp - before.stamp
    share = (stamp - before.stamp) / lasts if lasts > 0.0 else 0.0
    one, other = carried(before, stamp - before.stamp), carried(after, stamp - after.stamp)
    turn = math.remainder(other.heading - one.heading, 2.0 * math.pi)
    return PlanarPose(
        one.x + share * (other.x - one.x),
        one.y + share * (other.y - one.y),
        one.heading + share * turn,
    )
