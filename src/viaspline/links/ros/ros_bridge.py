"""Between a robot's messages and a navigator: messages in, messages out, no clock of its own."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

from viaspline.errors import GeometryError, LinkError
from viaspline.links.ros.asked_route import mission_from_here, mission_to
from viaspline.links.ros.drivable_mission import check_for_ros
from viaspline.links.ros.drive_news import DriveNews
from viaspline.links.ros.frame_tree import pose_from
from viaspline.links.ros.heard_inputs import HeardInputs
from viaspline.links.ros.odometry_history import HeardOfRobot
from viaspline.links.ros.ros_topics import Outgoing
from viaspline.mission.model import Mission
from viaspline.robot.navigator import Navigator
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.watching.fresh_inputs import STALE_S

STANDS_MPS: Final = 0.02
"""A robot that is slower stands [m/s]."""
START_WITHIN_M: Final = 1.0
"""A robot that stands farther from the mission's start isn't driven, unless it is asked for [m]."""
HELD: Final[Mapping[str, str]] = {
    "pose": f"the odometry is older than {STALE_S} s",
    "scan": f"the last scan is older than {STALE_S} s",
    "clock": "the clock runs backwards",
}
"""What a navigator waits for, in words."""


@dataclass(frozen=True, eq=False)
class RosBridge:
    """What is known of the robot, and what it is to do; a new one for every message and step.

    Times are by the clock of whoever calls, from any start on.

    Attributes:
        mission: What is driven, until a goal is heard.
        inputs: What is heard.
        start_within: How far from its start the robot may stand [m].
        nav: The navigator, once it is planned.
        used: The scan that it was shown last.
        odd: Why the last scan makes none; None if it does.
        wanted: What is to be planned; None: nothing.
        refusal: Why the last wasn't planned.
    """

    mission: Mission
    inputs: HeardInputs
    start_within: float = START_WITHIN_M
    nav: Navigator | None = None
    used: HeardOfRobot | None = None
    odd: str | None = None
    wanted: Mission | None = None
    refusal: str | None = None

    @classmethod
    def of(cls, mission: Mission, *, start_within: float = START_WITHIN_M) -> RosBridge:
        """The bridge before anything is heard; the mission is to be planned.

        Raises:
            LinkError: The mission can't be driven over ROS.
        """
        check_for_ros(mission)
        inputs = HeardInputs(mission.ros, mission.robot.sensor is not None)
        return cls(mission, inputs, start_within, wanted=mission)

    def news(self, now: float) -> DriveNews:
        """How messages are made now [s]."""
        return DriveNews(self.mission.ros, self.inputs.stamp(now))

    def heard(self, topic: str, message: Mapping[str, Any], now: float) -> RosBridge:
        """The bridge after a message.

        Args:
            topic: Where it was said.
            message: It, of the type that the topic has in ``heard_topics``.
            now: [s].
        """
        names = self.mission.ros
        if topic == names.initial_pose_topic:
            pose = pose_from(message["pose"]["pose"])
            return replace(self, inputs=self.inputs.placed(pose))
        if topic == names.goal_topic:
            return self._sent(message["header"]["frame_id"], [message["pose"]])
        if topic == names.waypoints_topic:
            poses = [one["pose"] for one in message["poses"]]
            return self._sent(message["header"]["frame_id"], poses) if poses else self
        inputs = self.inputs.after(topic, message, now)
        return self if inputs is self.inputs else replace(self, inputs=inputs)

    def _sent(self, frame: str, poses: Sequence[Mapping[str, Any]]) -> RosBridge:
        """With another mission to be planned once the robot stands."""
        within = self.inputs.frames.pose(frame, self.mission.ros.global_frame)
        try:
            mission = mission_to(self.mission, poses, frame, within)
        except LinkError as error:
            return replace(self, refusal=error.problem)
        return replace(
            self, mission=mission, wanted=mission, nav=None, refusal=None, start_within=math.inf
        )

    def lacks(self, now: float) -> str | None:
        """Why the robot is not to move now, in words; None: nothing is missing.

        Under way its navigator knows when what it is told is stale, and brakes.
        """
        lack = self.inputs.lacks()
        if lack is not None:
            return lack
        if self.odd is not None:
            return self.odd
        if self.nav is not None:
            return None if self.nav.held is None else HELD[self.nav.held]
        late = self.inputs.late(now)
        return None if late is None else HELD[late]

    def to_plan(self, now: float) -> Mission | None:
        """What is to be planned now: from where the robot stands; None: nothing yet.

        Raises:
            GeometryError: The map makes no grid.
        """
        state = self.inputs.state(now)
        if self.wanted is None or state is None or self.inputs.lacks() is not None:
            return None
        if self.inputs.late(now) is not None:
            return None
        if abs(state.speed) > STANDS_MPS or self.waits_far_off(now):
            return None
        chart = self.inputs.chart
        return mission_from_here(self.wanted, state, None if chart is None else chart.message)

    def waits_far_off(self, now: float) -> bool:
        """Whether the robot stands too far from the start of what is to be planned."""
        state = self.inputs.state(now)
        if self.wanted is None or state is None:
            return False
        return math.dist(state.position, self.wanted.route.start.at[:2]) > self.start_within

    def planned(self, nav: Navigator) -> RosBridge:
        """The bridge with the navigator of what was to be planned."""
        return replace(self, nav=nav, wanted=None, refusal=None, used=None, odd=None)

    def refused(self, words: str) -> RosBridge:
        """The bridge when what was to be planned can't be."""
        return replace(self, wanted=None, refusal=words)

    def stepped(self, now: float) -> tuple[Outgoing, RosBridge]:
        """What the robot is told now, and the bridge after that.

        Without a plan, and where anything was never heard, it is told to stand. A step that is
        refused ends the drive.
        """
        nav, news, state = self.nav, self.news(now), self.inputs.state(now)
        if nav is None or state is None or self.inputs.lacks() is not None:
            return news.told(None), self
        sensed, odd = self._sensed()
        try:
            command, after = nav.step(state, sensed, now)
        except GeometryError as error:
            return news.told(None), replace(self, nav=None, refusal=str(error))
        return news.told(command), replace(self, nav=after, used=self.inputs.scan, odd=odd)

    def _sensed(self) -> tuple[Scan | tuple[()], str | None]:
        """What the navigator is shown, and why the last scan makes none.

        Each scan is shown once: its noise is that of one look. Among things that move every step
        asks how far can be seen, and so it is shown again.
        """
        again = self.inputs.scan is self.used and self.mission.robot.moving is None
        if again:
            return (), self.odd
        try:
            return self.inputs.sensed(), None
        except GeometryError as error:
            return (), f"the last scan makes none: {error}"

    @property
    def over(self) -> bool:
        """Whether the drive is over: at the goal, or given up."""
        return self.nav is not None and self.nav.finished
