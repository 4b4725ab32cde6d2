"""What a drive says of itself as messages: commands, its path, its marks, how it goes.

Tested through ``links/ros/test_ros_bridge``.
"""

from __future__ import annotations

from typing import Any, Final, NamedTuple

from viaspline.links.ros.ros_topics import (
    DIAGNOSTIC_ARRAY,
    DIAGNOSTICS,
    MARKER_ARRAY,
    MARKERS,
    PATH,
    TWIST,
    TWIST_STAMPED,
    Outgoing,
)
from viaspline.mission.ros_spec import RosSpec
from viaspline.robot.navigator import Navigator
from viaspline.robot.state import Command
from viaspline.ros_messages.diagnostic_message import ERROR, OK, WARN, diagnostics
from viaspline.ros_messages.marker_message import forget_all
from viaspline.ros_messages.path_message import path_message
from viaspline.ros_messages.plan_marks import plan_marks
from viaspline.ros_messages.twist_message import command_twist, twist, twist_stamped

PATH_SPACING_M: Final = 0.1
MOST_POSES: Final = 1000
"""Of a path, at most: a longer one's are farther apart."""
MARK_SIZE_M: Final = 0.2
"""Of a mark at least; of a long path they are larger [m]."""


class DriveNews(NamedTuple):
    """How messages are made at one moment.

    Attributes:
        names: Of topics and frames.
        stamp: Of all headers, by the robot's clock [s].
    """

    names: RosSpec
    stamp: float

    def told(self, command: Command | None) -> Outgoing:
        """A command as a message; None: the robot is to stand."""
        stands = command is None or (command.finished and command.stopped)
        speeds: dict[str, Any] = twist(0.0) if command is None or stands else command_twist(command)
        topic = self.names.cmd_vel_topic
        if not self.names.enable_stamped_cmd_vel:
            return Outgoing(topic, TWIST, speeds)
        stamped = twist_stamped(self.stamp, self.names.robot_base_frame, speeds)
        return Outgoing(topic, TWIST_STAMPED, stamped)

    def path(self, nav: Navigator) -> Outgoing:
        """The path of a navigator."""
        spacing = max(PATH_SPACING_M, nav.path.length / MOST_POSES)
        message = path_message(self.stamp, nav.path, spacing, self.names.global_frame)
        return Outgoing(self.names.path_topic, PATH, message)

    def plan(self, nav: Navigator) -> list[Outgoing]:
        """What there is to show of a new plan: its path and its marks."""
        size = max(MARK_SIZE_M, 0.01 * nav.path.length)
        marks = [forget_all(self.stamp), *plan_marks(self.stamp, nav.plan, size)]
        return [self.path(nav), Outgoing(MARKERS, MARKER_ARRAY, {"markers": marks})]

    def health(self, nav: Navigator | None, refusal: str | None, lack: str | None) -> Outgoing:
        """How the drive goes.

        Args:
            nav: The navigator, once there is one.
            refusal: Why there is none.
            lack: Why the robot stands.
        """
        if refusal is not None:
            level, words = ERROR, refusal
        elif lack is not None:
            level, words = WARN, f"stands: {lack}"
        elif nav is None:
            level, words = WARN, "stands: nothing is planned yet"
        else:
            level, words = OK, "at the goal" if nav.reached else "drives"
        values = {}
        if nav is not None:
            left = nav.path.length - nav.distance
            values = {"distance_m": f"{nav.driven + nav.distance:.2f}", "left_m": f"{left:.2f}"}
        message = diagnostics(self.stamp, level, words, values)
        return Outgoing(DIAGNOSTICS, DIAGNOSTIC_ARRAY, message)
