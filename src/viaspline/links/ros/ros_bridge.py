"""Between a robot's messages and a navigator: messages in, messages out, no clock of its own."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Final, NamedTuple

from viaspline.errors import GeometryError
from viaspline.links.ros.drivable_mission import check_for_ros
from viaspline.links.ros.frame_tree import FrameTree, PlanarPose, pose_from
from viaspline.links.ros.ros_inputs import grid_from, scan_from
from viaspline.mission.model import Mission
from viaspline.mission.ros_spec import RosSpec
from viaspline.mission.route_spec import EndPoint, Route
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigator import Navigator
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.state import RobotState
from viaspline.ros_messages.diagnostic_message import ERROR, OK, WARN, diagnostics
from viaspline.ros_messages.marker_message import forget_all
from viaspline.ros_messages.odometry_message import state_from
from viaspline.ros_messages.path_message import path_message
from viaspline.ros_messages.plan_marks import plan_marks
from viaspline.ros_messages.stamps import seconds_of
from viaspline.ros_messages.twist_message import command_twist, twist, twist_stamped

STALE_S: Final = 0.2
"""A robot whose odometry or scan is older is stopped [s]."""
STANDS_MPS: Final = 0.02
"""A robot that is slower stands [m/s]."""
START_WITHIN_M: Final = 1.0
"""A robot that stands farther from the mission's start isn't driven, unless it is asked for [m]."""
PATH_SPACING_M: Final = 0.1
MARKERS: Final = "/viaspline/markers"
DIAGNOSTICS: Final = "/diagnostics"
TWIST: Final = "geometry_msgs/msg/Twist"
TWIST_STAMPED: Final = "geometry_msgs/msg/TwistStamped"


class Outgoing(NamedTuple):
    """A message to be published: where, its type's full name, and it."""

    topic: str
    kind: str
    message: Mapping[str, Any]


def pose_of(state: RobotState) -> PlanarPose:
    """Where a robot is, as a pose."""
    return PlanarPose(state.position[0], state.position[1], state.heading)


class HeardOfRobot(NamedTuple):
    """A message, and when it was heard [s]."""

    at: float
    message: Mapping[str, Any]


@dataclass(frozen=True, eq=False)
class RosBridge:
    """What is known of the robot, and what it is to do; a new one for every message and step.

    Times are by the clock of whoever calls, from any start on.

    Attributes:
        mission: What is driven, until a goal is heard.
        start_within: How far from its start the robot may stand [m].
        nav: The navigator, once it is planned.
        frames: What tf has told.
        odometry: The last that was heard.
        scan: Likewise.
        chart: The map, once it is heard.
        wanted: What is to be planned; None: nothing.
        refusal: Why the last wasn't planned.
    """

    mission: Mission
    start_within: float = START_WITHIN_M
    nav: Navigator | None = None
    frames: FrameTree = field(default_factory=FrameTree)
    odometry: HeardOfRobot | None = None
    scan: HeardOfRobot | None = None
    chart: HeardOfRobot | None = None
    wanted: Mission | None = None
    refusal: str | None = None

    @classmethod
    def of(cls, mission: Mission, *, start_within: float = START_WITHIN_M) -> RosBridge:
        """The bridge before anything is heard; the mission is to be planned.

        Raises:
            LinkError: The mission can't be driven over ROS.
        """
        check_for_ros(mission)
        return cls(mission, start_within, wanted=mission)

    @property
    def names(self) -> RosSpec:
        """Of topics and frames."""
        return self.mission.ros

    def listens_to(self) -> dict[str, str]:
        """The topics that it has to hear, with their types."""
        names = self.names
        topics = {
            names.odom_topic: "nav_msgs/msg/Odometry",
            "/tf": "tf2_msgs/msg/TFMessage",
            "/tf_static": "tf2_msgs/msg/TFMessage",
            names.initial_pose_topic: "geometry_msgs/msg/PoseWithCovarianceStamped",
            names.goal_topic: "geometry_msgs/msg/PoseStamped",
            names.waypoints_topic: "nav_msgs/msg/Path",
        }
        if self.has_lidar:
            topics[names.scan_topic] = "sensor_msgs/msg/LaserScan"
        if names.map_topic is not None:
            topics[names.map_topic] = "nav_msgs/msg/OccupancyGrid"
        return topics

    def says(self) -> dict[str, str]:
        """The topics on which it says something, with their types."""
        stamped = self.names.enable_stamped_cmd_vel
        return {
            self.names.cmd_vel_topic: TWIST_STAMPED if stamped else TWIST,
            self.names.path_topic: "nav_msgs/msg/Path",
            MARKERS: "visualization_msgs/msg/MarkerArray",
            DIAGNOSTICS: "diagnostic_msgs/msg/DiagnosticArray",
        }

    @property
    def has_lidar(self) -> bool:
        """Whether the robot drives by its scans."""
        return self.mission.robot.sensor is not None

    def heard(self, topic: str, message: Mapping[str, Any], now: float) -> RosBridge:
        """The bridge after a message.

        Args:
            topic: Where it was said.
            message: It, of the type that the topic has in ``listens_to``.
            now: [s].
        """
        names = self.names
        if topic in ("/tf", "/tf_static"):
            return replace(self, frames=self.frames.told(message))
        if topic == names.odom_topic:
            state = state_from(message)
            numbers = (*state.position, state.heading, state.speed, state.speed_across)
            if not all(math.isfinite(value) for value in numbers):
                return self  # as if it hadn't come: it gets stale
            return replace(self, odometry=HeardOfRobot(now, message))
        if topic == names.scan_topic:
            return replace(self, scan=HeardOfRobot(now, message))
        if topic == names.map_topic:
            return replace(self, chart=HeardOfRobot(now, message))
        if topic == names.initial_pose_topic:
            return self._placed(pose_from(message["pose"]["pose"]))
        if topic == names.goal_topic:
            return self._sent(message["header"]["frame_id"], [message["pose"]])
        if topic == names.waypoints_topic and message["poses"]:
            return self._sent(
                message["header"]["frame_id"], [one["pose"] for one in message["poses"]]
            )
        return self

    def _placed(self, pose: PlanarPose) -> RosBridge:
        """With the map where a person says that the robot is on it."""
        if self.odometry is None:
            return self
        base = self._base_in_odometry(self.odometry.at)
        frames = self.frames.having(
            self.names.global_frame, self._odometry_frame, pose.then(base.inverse)
        )
        return replace(self, frames=frames)

    def _sent(self, frame: str, poses: list[Mapping[str, Any]]) -> RosBridge:
        """With another mission to be planned once the robot stands."""
        within = self.frames.pose(frame, self.names.global_frame)
        if within is None:
            return replace(self, refusal=f"the goal's frame '{frame}' isn't connected to the map")
        places = [within.then(pose_from(pose)) for pose in poses]
        if not all(math.isfinite(value) for place in places for value in place):
            return replace(self, refusal="the goal isn't finite")
        *vias, goal = places
        route = Route.model_validate(
            {
                "start": self.mission.route.start,
                "via": [(via.x, via.y) for via in vias],
                "goal": {"at": (goal.x, goal.y), "heading_deg": math.degrees(goal.heading)},
            }
        )
        mission = self.mission.model_copy(update={"route": route})
        return replace(
            self, mission=mission, wanted=mission, nav=None, refusal=None, start_within=math.inf
        )

    @property
    def _odometry_frame(self) -> str:
        assert self.odometry is not None
        return self.odometry.message["header"]["frame_id"] or self.names.odom_frame

    def _base_in_odometry(self, now: float) -> PlanarPose:
        """Where the body is by odometry, carried on to now with the speeds that it had."""
        assert self.odometry is not None
        state = state_from(self.odometry.message)
        turn = float(self.odometry.message["twist"]["twist"]["angular"]["z"])
        age = now - self.odometry.at
        moved = PlanarPose(age * state.speed, age * state.speed_across, age * turn)
        return pose_of(state).then(moved)

    def state(self, now: float) -> RobotState | None:
        """Where the robot is on the map; None if that isn't known."""
        if self.odometry is None:
            return None
        odometry = self.frames.pose(self._odometry_frame, self.names.global_frame)
        if odometry is None:
            return None
        here = odometry.then(self._base_in_odometry(now))
        told = state_from(self.odometry.message)
        return RobotState((here.x, here.y), here.heading, told.speed, told.speed_across)

    def lacks(self, now: float) -> str | None:
        """Why the robot is not to move now, in words; None: nothing is missing."""
        names = self.names
        if self.odometry is None:
            return f"nothing is heard on {names.odom_topic}"
        if now - self.odometry.at > STALE_S:
            return f"the odometry is older than {STALE_S} s"
        if self.state(now) is None:
            return f"'{self._odometry_frame}' isn't connected to '{names.global_frame}' by tf"
        if self.has_lidar:
            if self.scan is None:
                return f"nothing is heard on {names.scan_topic}"
            if now - self.scan.at > STALE_S:
                return f"the last scan is older than {STALE_S} s"
            frame = self.scan.message["header"]["frame_id"]
            if self.frames.pose(frame, names.robot_base_frame) is None and not self._is_base(frame):
                return f"'{frame}' isn't connected to '{names.robot_base_frame}' by tf"
        if names.map_topic is not None and self.chart is None:
            return f"nothing is heard on {names.map_topic}"
        return None

    def _is_base(self, frame: str) -> bool:
        return frame.removeprefix("/") == self.names.robot_base_frame.removeprefix("/")

    def to_plan(self, now: float) -> Mission | None:
        """What is to be planned now: from where the robot stands; None: nothing yet.

        Raises:
            GeometryError: The map makes no grid.
        """
        state = self.state(now)
        if self.wanted is None or state is None or self.lacks(now) is not None:
            return None
        if abs(state.speed) > STANDS_MPS or self.waits_far_off(now):
            return None
        start = EndPoint(at=state.position, heading_deg=math.degrees(state.heading))
        route = self.wanted.route.model_copy(update={"start": start})
        mission = self.wanted.model_copy(update={"route": route})
        if self.chart is None:
            return mission
        known = (*mission.world.known, Obstacle(grid=grid_from(self.chart.message), name="map"))
        world = mission.world.model_copy(update={"known": known})
        return mission.model_copy(update={"world": world})

    def waits_far_off(self, now: float) -> bool:
        """Whether the robot stands too far from the start of what is to be planned."""
        state = self.state(now)
        if self.wanted is None or state is None:
            return False
        return math.dist(state.position, self.wanted.route.start.at[:2]) > self.start_within

    def stamp(self, now: float) -> float:
        """A time by the robot's clock [s]: as the stamps of its odometry have it."""
        if self.odometry is None:
            return now
        return now + seconds_of(self.odometry.message["header"]["stamp"]) - self.odometry.at

    def planned(self, nav: Navigator) -> RosBridge:
        """The bridge with the navigator of what was to be planned."""
        return replace(self, nav=nav, wanted=None, refusal=None)

    def refused(self, words: str) -> RosBridge:
        """The bridge when what was to be planned can't be."""
        return replace(self, wanted=None, refusal=words)

    def stepped(self, now: float) -> tuple[list[Outgoing], RosBridge]:
        """What to publish now, and the bridge after that.

        Without a plan, and where anything is missing or stale, the robot is told to stand.
        """
        nav = self.nav
        if nav is None or self.lacks(now) is not None:
            return [self.stop(now)], self
        state = self.state(now)
        assert state is not None
        try:
            command, after = nav.step(state, self._sensed(now), now)
        except GeometryError as error:
            return [self.stop(now)], replace(self, nav=None, refusal=str(error))
        speeds = twist(0.0) if command.finished and command.stopped else command_twist(command)
        said = [self._told(now, speeds)]
        if after.path is not nav.path:
            said.append(self.path_of(after, now))
        return said, replace(self, nav=after)

    def announced(self, now: float) -> list[Outgoing]:
        """What there is to show of a new plan: its path and its marks."""
        assert self.nav is not None
        size = max(0.2, 0.01 * self.nav.path.length)
        marks = [forget_all(self.stamp(now)), *plan_marks(self.stamp(now), self.nav.plan, size)]
        shown = Outgoing(MARKERS, "visualization_msgs/msg/MarkerArray", {"markers": marks})
        return [self.path_of(self.nav, now), shown]

    def health(self, now: float) -> Outgoing:
        """How the drive goes, as a message of diagnostics."""
        lack = self.lacks(now)
        if self.refusal is not None:
            level, words = ERROR, self.refusal
        elif lack is not None:
            level, words = WARN, f"stands: {lack}"
        elif self.nav is None:
            level, words = WARN, "stands: nothing is planned yet"
        else:
            level, words = OK, "at the goal" if self.nav.reached else "drives"
        values = {}
        if self.nav is not None:
            left = self.nav.path.length - self.nav.distance
            values = {"distance_m": f"{self.nav.distance:.2f}", "left_m": f"{left:.2f}"}
        message = diagnostics(self.stamp(now), level, words, values)
        return Outgoing(DIAGNOSTICS, "diagnostic_msgs/msg/DiagnosticArray", message)

    def path_of(self, nav: Navigator, now: float) -> Outgoing:
        """The path of a navigator, as a message."""
        frame, spacing = self.names.global_frame, max(PATH_SPACING_M, nav.path.length / 1000)
        message = path_message(self.stamp(now), nav.path, spacing, frame)
        return Outgoing(self.names.path_topic, "nav_msgs/msg/Path", message)

    def stop(self, now: float) -> Outgoing:
        """The message by which the robot stands."""
        return self._told(now, twist(0.0))

    def _told(self, now: float, speeds: dict[str, Any]) -> Outgoing:
        topic = self.names.cmd_vel_topic
        if not self.names.enable_stamped_cmd_vel:
            return Outgoing(topic, TWIST, speeds)
        stamped = twist_stamped(self.stamp(now), self.names.robot_base_frame, speeds)
        return Outgoing(topic, TWIST_STAMPED, stamped)

    def _sensed(self, now: float) -> Scan | tuple[()]:
        """The last scan, from where the sensor was when it was heard."""
        if not self.has_lidar:
            return ()
        assert self.scan is not None
        state = self.state(self.scan.at)
        assert state is not None
        frame = self.scan.message["header"]["frame_id"]
        mount = self.frames.pose(frame, self.names.robot_base_frame) or PlanarPose(0.0, 0.0, 0.0)
        at = pose_of(state).then(mount)
        return scan_from(self.scan.message, at)

    @property
    def over(self) -> bool:
        """Whether the drive is over: at the goal, or given up."""
        return self.nav is not None and self.nav.finished
