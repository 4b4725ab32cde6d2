"""The bridge and its runner without a network: a pretended robot and a pretended clock."""

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

import viaspline as vs
from viaspline.errors import LinkError
from viaspline.links.ros.frame_tree import FrameTree, PlanarPose
from viaspline.links.ros.heard_inputs import HeardInputs
from viaspline.links.ros.ros_bridge import RosBridge
from viaspline.links.ros.ros_map import grid_from
from viaspline.links.ros.ros_runner import RosRunner
from viaspline.links.ros.ros_topics import said_topics
from viaspline.mission.ros_spec import RosSpec

from .pretend_robot import PretendRobot, transform, turned

ROBOT = {
    "radius_m": 0.3, "clearance_m": 0.15, "max_speed_mps": 0.8, "max_accel_mps2": 0.8,
    "tracking_error_m": 0.1, "drive": {"differential": {"track_m": 0.4}, "delay_s": 0.1},
}  # fmt: skip
ROUTE = {"start": [1, 2], "goal": [7, 2]}
POST = vs.Obstacle.model_validate({"circle": {"center": [4, 2.1], "radius": 0.3}})
LIDAR = {"lidar": {"range_m": 4, "fov_deg": 360, "beams": 180}}


def mission(**more: Any) -> vs.Mission:
    robot = {**ROBOT, **more.pop("robot", {})}
    return vs.Mission.model_validate({"robot": robot, "route": ROUTE, **more})


class PretendLink:
    """The robot's world goes on by 10 ms whenever its messages are waited for."""

    def __init__(self, robot: PretendRobot, silent: Callable[[str, float], bool] | None = None):
        self.robot, self.time = robot, 0.0
        self.silent = silent or (lambda topic, time: False)
        self.said: list[tuple[float, str, Any]] = []
        self.extra: dict[float, list[tuple[str, Any]]] = {}

    def clock(self) -> float:
        return self.time

    def publish(self, topic: str, message: Any) -> None:
        self.said.append((self.time, topic, message))
        if topic == "/cmd_vel":
            self.robot.hears(self.time, message)

    def messages(self, patience: float) -> Iterator[tuple[float, str, dict[str, Any]]]:
        self.time += 0.01
        time, robot = self.time, self.robot
        tick = round(time / 0.01)
        robot.moves(time, 0.01)
        heard: list[tuple[str, Any]] = self.extra.pop(tick, [])
        if tick == 1:
            heard.append(("/tf_static", robot.laser_mount(time)))
        if tick % 10 == 1:
            heard.append(("/tf", robot.map_to_odom(time)))
        if tick % 2 == 0:
            heard.append(("/odom", robot.odometry(time)))
        if tick % 5 == 0 and robot.lidar is not None:
            heard.append(("/scan", robot.scan(time)))
        yield from ((time, topic, one) for topic, one in heard if not self.silent(topic, time))

    def commands(self) -> list[tuple[float, float]]:
        return [(time, m["linear"]["x"]) for time, topic, m in self.said if topic == "/cmd_vel"]


def runner(link: PretendLink, asked: vs.Mission, **more: Any) -> RosRunner:
    def plan(one: vs.Mission) -> vs.Navigator:
        return vs.Navigator(one)

    bridge = RosBridge.of(asked, start_within=more.pop("start_within", 1.0))
    return RosRunner(
        link, bridge, plan, link.clock, period=0.05, tell=more.pop("tell", lambda words: None),
        **more,
    )  # fmt: skip


def test_a_robot_is_driven_to_its_goal_by_odometry_and_tf() -> None:
    robot = PretendRobot([POST], None, (1.1, 1.9, 0.3))
    link = PretendLink(robot)
    asked = mission(world={"known": [POST.model_dump(exclude_defaults=True)]})
    ended = runner(link, asked).run()
    assert ended.reached, ended.words
    assert ended.stops == 0
    assert math.dist((robot.x, robot.y), (7, 2)) < 0.1
    assert robot.nearest >= 0.3 + 0.15 - 1e-3
    assert [speed for _, speed in link.commands()][-3:] == [0.0, 0.0, 0.0]
    topics = {topic for _, topic, _ in link.said}
    assert topics == {"/cmd_vel", "/plan", "/diagnostics", "/viaspline/markers"}
    path = next(m for _, topic, m in link.said if topic == "/plan")
    assert path["header"]["stamp"]["sec"] >= 1_700_000_000
    first = path["poses"][0]["pose"]["position"]
    assert (first["x"], first["y"]) == pytest.approx((1.1, 1.9), abs=0.01)


def test_a_robot_goes_round_what_only_its_lidar_sees() -> None:
    from viaspline.mission.sensor_spec import Lidar

    robot = PretendRobot([POST], Lidar.model_validate(LIDAR["lidar"]), (1.0, 2.0, 0.0))
    link = PretendLink(robot)
    ended = runner(link, mission(robot={"sensor": LIDAR})).run()
    assert ended.reached, ended.words
    assert math.dist((robot.x, robot.y), (7, 2)) < 0.15
    assert robot.nearest >= 0.3 + 0.05


@pytest.mark.parametrize("lost", ["/odom", "/scan"])
def test_a_robot_that_hears_nothing_any_more_is_told_to_stand(lost: str) -> None:
    from viaspline.mission.sensor_spec import Lidar

    robot = PretendRobot([], Lidar.model_validate(LIDAR["lidar"]), (1.0, 2.0, 0.0))
    link = PretendLink(robot, lambda topic, time: topic == lost and 3.0 < time < 5.0)
    words: list[str] = []
    ended = runner(link, mission(robot={"sensor": LIDAR}), tell=words.append).run()
    assert ended.reached
    assert ended.stops == 1
    assert any("older than 0.2 s" in one for one in words)
    braked = [speed for time, speed in link.commands() if 3.2 < time < 4.3]
    assert braked == sorted(braked, reverse=True)
    while_lost = [speed for time, speed in link.commands() if 4.3 < time < 5.0]
    assert while_lost
    assert set(while_lost) == {0.0}


def test_nothing_moves_while_frames_never_connect() -> None:
    robot = PretendRobot([], None, (1.0, 2.0, 0.0))
    link = PretendLink(robot, lambda topic, time: topic == "/tf")

    def enough(words: str) -> None:
        if "isn't connected to 'map'" in words:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        runner(link, mission(), tell=enough).run()
    assert {speed for _, speed in link.commands()} == {0.0}


@pytest.mark.parametrize("moment", [0.5, 2.0, 4.0])
def test_a_robot_stands_after_an_interrupt_or_a_defect_whenever_it_comes(moment: float) -> None:
    robot = PretendRobot([], None, (1.0, 2.0, 0.0))

    def broken(topic: str, time: float) -> bool:
        if time > moment:
            raise KeyboardInterrupt
        return False

    link = PretendLink(robot, broken)
    with pytest.raises(KeyboardInterrupt):
        runner(link, mission()).run()
    assert [speed for _, speed in link.commands()][-3:] == [0.0] * 3


def test_a_robot_far_from_the_start_is_not_driven_unless_it_is_asked_for() -> None:
    robot = PretendRobot([], None, (3.0, 3.0, 0.0))
    link = PretendLink(robot)

    def enough(words: str) -> None:
        if "too far from the mission's start" in words:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        runner(link, mission(), tell=enough).run()
    assert {speed for _, speed in link.commands()} == {0.0}
    again = runner(PretendLink(robot), mission(), start_within=math.inf).run()
    assert again.reached


def test_a_goal_under_way_stops_the_robot_first_and_leads_it_there() -> None:
    robot = PretendRobot([], None, (1.0, 2.0, 0.0))
    link = PretendLink(robot)
    goal = {"position": {"x": 4.0, "y": 4.0, "z": 0.0}, "orientation": turned(math.pi / 2)}
    stamp = {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": "map"}
    link.extra[300] = [("/goal_pose", {"header": stamp, "pose": goal})]
    ended = runner(link, mission()).run()
    assert ended.reached
    assert math.dist((robot.x, robot.y), (4, 4)) < 0.1
    stood = [speed for time, speed in link.commands() if 3.0 < time < 3.1]
    assert set(stood[1:]) == {0.0}
    other = RosBridge.of(mission()).heard(
        "/goal_pose", {"header": {**stamp, "frame_id": "moon"}, "pose": goal}, 0.0
    )
    assert other.refusal is not None
    assert "moon" in other.refusal


def test_waypoints_are_a_route_and_the_map_is_kept_clear_of() -> None:
    robot = PretendRobot([], None, (1.0, 2.0, 0.0))
    bridge = RosBridge.of(mission(ros={"map_topic": "/map"}))
    bridge = bridge.heard("/tf", robot.map_to_odom(0.0), 0.0)
    bridge = bridge.heard("/odom", robot.odometry(0.0), 0.0)
    assert bridge.lacks(0.0) == "nothing is heard on /map"
    cells = np.zeros((40, 60), np.int8)
    cells[18:22, 30] = 100
    cells[0, 0] = -1
    info = {
        "resolution": 0.2, "width": 60, "height": 40,
        "origin": {"position": {"x": -1.0, "y": -2.0, "z": 0.0}, "orientation": turned(0.0)},
    }  # fmt: skip
    bridge = bridge.heard("/map", {"info": info, "data": cells.ravel()}, 0.0)
    places = [(3.0, 2.0), (8.0, 2.0)]
    poses = [
        {"pose": {"position": {"x": x, "y": y, "z": 0.0}, "orientation": turned(0.0)}}
        for x, y in places
    ]
    bridge = bridge.heard("/waypoints", {"header": {"frame_id": "map"}, "poses": poses}, 0.0)
    asked = bridge.to_plan(0.0)
    assert asked is not None
    assert [via.at for via in asked.route.via] == [(3.0, 2.0)]
    assert asked.route.goal is not None
    assert asked.route.goal.at == (8.0, 2.0)
    plan = vs.plan(asked)
    assert plan.certificate.obstacle == "map"
    assert plan.certificate.holds


def test_a_person_can_say_where_the_robot_is() -> None:
    robot = PretendRobot([], None, (1.0, 2.0, 0.5))
    bridge = RosBridge.of(mission()).heard("/odom", robot.odometry(0.0), 0.0)
    assert bridge.inputs.state(0.0) is None
    pose = {"position": {"x": 1.0, "y": 2.0, "z": 0.0}, "orientation": turned(0.5)}
    bridge = bridge.heard("/initialpose", {"pose": {"pose": pose}}, 0.0)
    state = bridge.inputs.state(0.0)
    assert state is not None
    assert (*state.position, state.heading) == pytest.approx((1.0, 2.0, 0.5))


def test_twists_have_stamps_where_they_are_asked_for() -> None:
    asked = mission(ros={"enable_stamped_cmd_vel": True, "cmd_vel_topic": "/go"})
    assert said_topics(asked.ros)["/go"] == "geometry_msgs/msg/TwistStamped"
    said = RosBridge.of(asked).news(0.0).told(None)
    assert said.topic == "/go"
    assert said.message["twist"]["linear"]["x"] == 0.0


def test_odometry_that_is_no_number_counts_as_none() -> None:
    robot = PretendRobot([], None, (math.nan, 2.0, 0.0))
    assert RosBridge.of(mission()).heard("/odom", robot.odometry(0.0), 0.0).inputs.odometry is None


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"robot": {"drive": None, "tracking_error_m": None}}, "how the robot drives"),
        ({"robot": {"sensor": {"range_m": 5}}}, "whole obstacles"),
    ],
)
def test_missions_that_ros_cannot_drive_are_refused(more: Any, words: str) -> None:
    with pytest.raises(LinkError, match=words):
        RosBridge.of(mission(**more))


def test_frames_connect_by_their_parents_and_not_round_a_circle() -> None:
    tree = FrameTree().having("map", "odom", PlanarPose(1, 2, math.pi / 2))
    tree = tree.having("/odom", "base_link", PlanarPose(3, 0, 0)).having(
        "a", "b", PlanarPose(0, 0, 0)
    )
    assert tree.pose("base_link", "map") == pytest.approx((1, 5, math.pi / 2))
    assert tree.pose("map", "base_link") == pytest.approx((-5, 1, -math.pi / 2))
    assert tree.pose("a", "map") is None
    circle = tree.having("b", "a", PlanarPose(0, 0, 0))
    assert circle.pose("a", "map") is None
    assert tree.having("map", "odom", PlanarPose(math.nan, 0, 0)) is tree


def laser(ranges: list[float], **more: Any) -> dict[str, Any]:
    usual = {"angle_min": 0.0, "angle_increment": 0.5, "range_min": 0.1, "range_max": 9.0}
    stamp = {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": "base_link"}
    return {"header": stamp, **usual, **more, "ranges": np.array(ranges, np.float32)}


def sensed(message: dict[str, Any]) -> Any:
    robot = PretendRobot([], None, (1.0, 2.0, 0.0))
    inputs = HeardInputs(RosSpec(), has_lidar=True)
    for topic, one in (
        ("/tf", robot.map_to_odom(0.0)), ("/odom", robot.odometry(0.0)), ("/scan", message)
    ):  # fmt: skip
        inputs = inputs.after(topic, one, 0.0)
    return inputs.sensed()


def test_scans_of_nothing_backwards_and_with_odd_numbers_are_read() -> None:
    assert sensed(laser([])).shows_nothing
    with pytest.raises(vs.GeometryError):
        sensed(laser([1.0], angle_min=math.nan))
    odd = sensed(laser([0.0, math.nan, math.inf, 3.0, 50.0, -math.inf]))
    np.testing.assert_array_equal(odd.ranges, [np.nan, np.nan, np.inf, 3, np.nan, np.nan])
    forth = sensed(laser([1.0, 2.0, 3.0]))
    back = sensed(laser([3.0, 2.0, 1.0], angle_min=1.0, angle_increment=-0.5))
    np.testing.assert_allclose(forth.hits, back.hits)
    assert len(sensed(laser([1.0] * 15)).ranges) == 12  # more than one turn


@pytest.mark.parametrize(
    "odd",
    [
        {"ranges": np.zeros(0, np.float32)},
        {"ranges": np.full(180, np.nan, np.float32)},
        {"angle_min": math.nan},
        {"angle_increment": 0.0},
        {"range_max": -1.0},
    ],
)
def test_scans_that_tell_nothing_stop_the_robot_until_there_are_others(odd: Any) -> None:
    from viaspline.mission.sensor_spec import Lidar

    robot = PretendRobot([], Lidar.model_validate(LIDAR["lidar"]), (1.0, 2.0, 0.0))
    link = PretendLink(robot)
    right = robot.scan
    robot.scan = lambda time: {**right(time), **(odd if 2.0 < time < 4.5 else {})}  # type: ignore[method-assign]
    words: list[str] = []
    short = {"start": [1, 2], "goal": [4, 2]}
    ended = runner(link, mission(robot={"sensor": LIDAR}, route=short), tell=words.append).run()
    assert ended.reached, ended.words
    assert ended.stops >= 1
    meanwhile = [speed for time, speed in link.commands() if 3.5 < time < 4.5]
    assert meanwhile
    assert set(meanwhile) == {0.0}


def test_a_scan_is_placed_where_the_robot_was_when_it_was_taken() -> None:
    robot = PretendRobot([], None, (1.0, 2.0, 0.0))
    robot.speed, robot.turn = 1.0, 0.5
    inputs = HeardInputs(RosSpec(), has_lidar=True)
    inputs = inputs.after("/tf", robot.map_to_odom(9.0), 9.0)
    inputs = inputs.after("/odom", robot.odometry(9.0), 9.0)
    late = laser([1.0, 2.0]) | {
        "header": {**robot.odometry(8.9)["header"], "frame_id": "base_link"}
    }
    scan = inputs.after("/scan", late, 9.02).sensed()
    assert isinstance(scan, vs.Scan)
    assert (*scan.position, scan.heading) == pytest.approx((0.9, 2.0025, -0.05), abs=1e-4)
    assert scan.stamp == 9.02
    unstamped = inputs.after("/scan", laser([1.0, 2.0]), 9.02).sensed()
    assert isinstance(unstamped, vs.Scan)
    assert unstamped.position == pytest.approx((1.02, 2.0001), abs=1e-4)


def scan_of(time: float, robot: PretendRobot) -> dict[str, Any]:
    return laser([1.0, 2.0]) | {
        "header": {**robot.odometry(time)["header"], "frame_id": "base_link"}
    }


def test_a_scan_waits_for_the_odometry_that_tells_where_it_was_taken() -> None:
    robot = PretendRobot([], None, (1.0, 2.0, 0.0))
    inputs = HeardInputs(RosSpec(), has_lidar=True)
    inputs = inputs.after("/tf", robot.map_to_odom(9.0), 9.0)
    inputs = inputs.after("/odom", robot.odometry(9.0), 9.0)
    inputs = inputs.after("/scan", scan_of(9.05, robot), 9.05)
    assert inputs.look is None
    robot.x, robot.y, robot.heading = 1.1, 2.0, 0.2  # which its speed of 0 doesn't foretell
    inputs = inputs.after("/odom", robot.odometry(9.1), 9.06)
    scan = inputs.sensed()
    assert isinstance(scan, vs.Scan)
    assert (*scan.position, scan.heading) == pytest.approx((1.05, 2.0, 0.1), abs=1e-6)
    assert inputs.look is not None


def test_a_scan_does_not_wait_for_ever_and_the_newest_that_is_placed_counts() -> None:
    robot = PretendRobot([], None, (1.0, 2.0, 0.0))
    inputs = HeardInputs(RosSpec(), has_lidar=True)
    inputs = inputs.after("/tf", robot.map_to_odom(9.0), 9.0)
    for time in (9.01, 9.02, 9.03):
        inputs = inputs.after("/scan", scan_of(time, robot), time)
    inputs = inputs.after("/odom", robot.odometry(9.02), 9.04)
    assert inputs.look is not None
    assert inputs.look.at == 9.02
    inputs = inputs.after("/tf", robot.map_to_odom(9.2), 9.2)
    assert inputs.look is not None
    assert inputs.look.at == 9.03


def test_a_domain_full_of_other_robots_changes_nothing() -> None:
    robot = PretendRobot([], None, (1.0, 2.0, 0.0))
    link = PretendLink(robot)
    others = [
        transform(0.0, f"robot{k}/odom", f"robot{k}/base_link", 9.0, 9.0, 1.0)["transforms"][0]
        for k in range(300)
    ]
    nobody = {"frame_id": "robot7/odom", "stamp": {"sec": 0, "nanosec": 0}}
    goal = {"position": {"x": 9.0, "y": 9.0, "z": 0.0}, "orientation": turned(0.0)}
    for tick in range(20, 900, 20):
        link.extra[tick] = [("/tf", {"transforms": others}), ("/robot7/scan", {})]
    link.extra[250] = [("/robot7/goal_pose", {"header": nobody, "pose": goal})]
    ended = runner(link, mission()).run()
    assert ended.reached, ended.words
    assert ended.stops == 0
    assert math.dist((robot.x, robot.y), (7, 2)) < 0.1


def test_a_map_that_contradicts_itself_is_refused() -> None:
    with pytest.raises(vs.GeometryError, match="has 3 cells"):
        grid_from({"info": {"height": 2, "width": 2}, "data": np.zeros(3, np.int8)})
