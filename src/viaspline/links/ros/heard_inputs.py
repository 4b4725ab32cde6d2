"""What a robot has said of itself, and what that makes for a navigator: its state and its scans.

Tested through ``links/ros/test_ros_bridge``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Final, NamedTuple

from viaspline.links.ros.frame_tree import SAME, FrameTree, PlanarPose
from viaspline.links.ros.ros_topics import FRAME_TOPICS
from viaspline.mission.ros_spec import RosSpec
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.state import RobotState
from viaspline.robot.watching.fresh_inputs import STALE_S
from viaspline.ros_messages.odometry_message import state_from
from viaspline.ros_messages.stamps import seconds_of

RECENT: Final = 20
"""So many messages of odometry are kept: a scan goes with the one that is nearest to it in time."""
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
class HeardInputs:
    """The last that was heard of everything; a new one for every message.

    Attributes:
        names: Of topics and frames.
        has_lidar: Whether scans are waited for.
        frames: What tf has told.
        odometry: The last that was heard.
        recent: The last ones of it.
        scan: The last that was heard.
        chart: The map, once it is heard.
    """

    names: RosSpec
    has_lidar: bool
    frames: FrameTree = field(default_factory=FrameTree)
    odometry: HeardOfRobot | None = None
    recent: tuple[HeardOfRobot, ...] = ()
    scan: HeardOfRobot | None = None
    chart: HeardOfRobot | None = None

    def after(self, topic: str, message: Mapping[str, Any], now: float) -> HeardInputs:
        """It after a message at a time [s]; odometry that isn't finite is as if it hadn't come."""
        names = self.names
        if topic in FRAME_TOPICS:
            return replace(self, frames=self.frames.told(message))
        if topic == names.odom_topic:
            state = state_from(message)
            numbers = *state.position, state.heading, state.speed, state.speed_across
            finite = all(math.isfinite(value) for value in (*numbers, _turning(message)))
            if not finite:
                return self
            heard = HeardOfRobot(now, message)
            return replace(self, odometry=heard, recent=(*self.recent[1 - RECENT :], heard))
        if topic == names.scan_topic:
            return replace(self, scan=HeardOfRobot(now, message))
        if topic == names.map_topic:
            return replace(self, chart=HeardOfRobot(now, message))
        return self

    def placed(self, pose: PlanarPose) -> HeardInputs:
        """With the map where a person says that the robot is on it."""
        if self.odometry is None:
            return self
        base = _carried(self.odometry, 0.0)
        frames = self.frames.having(
            self.names.global_frame, self._odometry_frame, pose.then(base.inverse)
        )
        return replace(self, frames=frames)

    def state(self, now: float) -> RobotState | None:
        """Where the robot is on the map, for a navigator; None if that isn't known.

        Its stamp says when its odometry was heard, and its place is that of then: a navigator
        carries it on, and knows when it is stale. Only its heading is carried on here, because a
        ``RobotState`` doesn't tell how fast it turns.
        """
        at = self._on_map()
        if self.odometry is None or at is None:
            return None
        told = state_from(self.odometry.message)
        here = at.then(_carried(self.odometry, 0.0))
        turned = max(now - self.odometry.at, 0.0) * _turning(self.odometry.message)
        return RobotState(
            (here.x, here.y), here.heading + turned, told.speed, told.speed_across,
            self.odometry.at,
        )  # fmt: skip

    def sensed(self) -> Scan | tuple[()]:
        """The last scan, from where the sensor was when it was taken; nothing without a lidar.

        Its stamp says when it was heard.

        Raises:
            GeometryError: The message makes no scan.
        """
        if not self.has_lidar or self.scan is None:
            return ()
        on_map = self._on_map()
        mount = self._mount
        assert on_map is not None
        assert mount is not None
        base = on_map.then(self._base_at(self.scan))
        told = self.scan.message
        return Scan.from_laserscan(
            told["ranges"], told["angle_min"], told["angle_increment"], told["range_min"],
            told["range_max"], base, mount=mount, stamp=self.scan.at,
        )  # fmt: skip

    def lacks(self) -> str | None:
        """What was never heard, or never connects, in words; None: nothing is missing."""
        names = self.names
        if self.odometry is None:
            return f"nothing is heard on {names.odom_topic}"
        if self._on_map() is None:
            return f"'{self._odometry_frame}' isn't connected to '{names.global_frame}' by tf"
        if self.has_lidar:
            if self.scan is None:
                return f"nothing is heard on {names.scan_topic}"
            if self._mount is None:
                frame, base = self.scan.frame, names.robot_base_frame
                return f"'{frame}' isn't connected to '{base}' by tf"
        if names.map_topic is not None and self.chart is None:
            return f"nothing is heard on {names.map_topic}"
        return None

    def late(self, now: float) -> str | None:
        """What a plan can't be begun from because it is older than 0.2 s: ``pose`` or ``scan``.

        Under way a navigator sees to that.
        """
        last = {"pose": self.odometry, "scan": self.scan if self.has_lidar else self.odometry}
        return next(
            (what for what, one in last.items() if one is None or now - one.at > STALE_S), None
        )

    def stamp(self, now: float) -> float:
        """A time by the robot's clock [s]: as the stamps of its odometry have it."""
        if self.odometry is None:
            return now
        return now + self.odometry.stamp - self.odometry.at

    @property
    def _odometry_frame(self) -> str:
        assert self.odometry is not None
        return self.odometry.frame or self.names.odom_frame

    @property
    def _mount(self) -> PlanarPose | None:
        """Where the scanner is on the body; None if that isn't known."""
        assert self.scan is not None
        frame, base = self.scan.frame, self.names.robot_base_frame
        same = frame.removeprefix("/") == base.removeprefix("/")
        return SAME if same else self.frames.pose(frame, base)

    def _on_map(self) -> PlanarPose | None:
        """Where the odometry's frame is on the map; None if that isn't known."""
        if self.odometry is None:
            return None
        return self.frames.pose(self._odometry_frame, self.names.global_frame)

    def _base_at(self, scan: HeardOfRobot) -> PlanarPose:
        """Where the body was by odometry when a scan was taken.

        Its stamp is the robot's, and so is that of the odometry; a driver that stamps nothing, or
        by another clock, is taken to have said it at once.
        """
        assert self.odometry is not None
        nearest = min(self.recent, key=lambda one: abs(scan.stamp - one.stamp))
        after = scan.stamp - nearest.stamp
        if scan.stamp == 0.0 or abs(after) > ONE_CLOCK_S:
            return _carried(self.odometry, scan.at - self.odometry.at)
        return _carried(nearest, after)


def _carried(odometry: HeardOfRobot, seconds: float) -> PlanarPose:
    """Where a body is by odometry a short time later or, below 0, before [s]."""
    state, turned = state_from(odometry.message), seconds * _turning(odometry.message)
    way = math.hypot(state.speed, state.speed_across) * seconds
    course = state.heading + 0.5 * turned + math.atan2(state.speed_across, state.speed)
    x, y = state.position[:2]
    return PlanarPose(
        x + way * math.cos(course), y + way * math.sin(course), state.heading + turned
    )


def _turning(odometry: Mapping[str, Any]) -> float:
    """How fast a body turns by a message of odometry [rad/s]."""
    return float(odometry["twist"]["twist"]["angular"]["z"])
