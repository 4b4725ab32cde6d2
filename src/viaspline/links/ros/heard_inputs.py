"""What a robot has said of itself, and what that makes for a navigator: its state and its scans.

Tested through ``links/ros/test_ros_bridge``.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Final

from viaspline.links.ros.frame_tree import SAME, FrameTree, PlanarPose
from viaspline.links.ros.odometry_history import (
    HeardOfRobot,
    OdometryHistory,
    carried,
    turning,
)
from viaspline.links.ros.ros_topics import FRAME_TOPICS
from viaspline.mission.ros_spec import RosSpec
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.state import RobotState
from viaspline.robot.watching.fresh_inputs import STALE_S
from viaspline.ros_messages.odometry_message import state_from

SCAN_WAITS_S: Final = 0.1
"""So long a scan waits for odometry that is as new; then it is placed by what there is [s]."""
MOST_WAITING: Final = 20
"""Scans that wait for odometry; beyond that the oldest is dropped."""


@dataclass(frozen=True, eq=False)
class HeardInputs:
    """The last that was heard of everything; a new one for every message.

    Attributes:
        names: Of topics and frames.
        has_lidar: Whether scans are waited for.
        frames: What tf has told.
        history: What odometry has said lately.
        scan: The last whose place is known.
        waiting: Newer ones, which wait for odometry that tells where they were taken.
        chart: The map, once it is heard.
    """

    names: RosSpec
    has_lidar: bool
    frames: FrameTree = field(default_factory=FrameTree)
    history: OdometryHistory = field(default_factory=OdometryHistory)
    scan: HeardOfRobot | None = None
    waiting: tuple[HeardOfRobot, ...] = ()
    chart: HeardOfRobot | None = None

    @property
    def odometry(self) -> HeardOfRobot | None:
        """The last that was heard."""
        return self.history.last

    @property
    def look(self) -> HeardOfRobot | None:
        """What a step is made for: the last scan, or without a lidar the last odometry."""
        return self.scan if self.has_lidar else self.odometry

    def after(self, topic: str, message: Mapping[str, Any], now: float) -> HeardInputs:
        """It after a message at a time [s]; odometry that isn't finite is as if it hadn't come."""
        return self._with(topic, message, now)._with_placed_scans(now)

    def _with(self, topic: str, message: Mapping[str, Any], now: float) -> HeardInputs:
        names = self.names
        if topic in FRAME_TOPICS:
            return replace(self, frames=self.frames.told(message))
        if topic == names.odom_topic:
            state = state_from(message)
            numbers = *state.position, state.heading, state.speed, state.speed_across
            finite = all(math.isfinite(value) for value in (*numbers, turning(message)))
            if not finite:
                return self
            return replace(self, history=self.history.having(HeardOfRobot(now, message)))
        if topic == names.scan_topic:
            waiting = (*self.waiting[1 - MOST_WAITING :], HeardOfRobot(now, message))
            return replace(self, waiting=waiting)
        if topic == names.map_topic:
            return replace(self, chart=HeardOfRobot(now, message))
        return self

    def _with_placed_scans(self, now: float) -> HeardInputs:
        """With the newest scan that is placed, or has waited too long, as the last one.

        Odometry may be heard a little after a scan of the same time. Carried on from before, a
        robot that speeds up or turns would be centimetres off, and see walls where there are none.
        """
        due = [
            place
            for place, one in enumerate(self.waiting)
            if self.history.covers(one) or now - one.at >= SCAN_WAITS_S
        ]
        if not due or self.odometry is None:
            return self
        return replace(self, scan=self.waiting[due[-1]], waiting=self.waiting[due[-1] + 1 :])

    def placed(self, pose: PlanarPose) -> HeardInputs:
        """With the map where a person says that the robot is on it."""
        if self.odometry is None:
            return self
        base = carried(self.odometry, 0.0)
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
        here = at.then(carried(self.odometry, 0.0))
        turned = max(now - self.odometry.at, 0.0) * turning(self.odometry.message)
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
        base = on_map.then(self.history.base_at(self.scan))
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
