"""``viaspline drive --ros``: a pretended robot at the other end of real sockets."""

import json
import math
import socket
import threading
import time
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from viaspline.cli import cli
from viaspline.commands.drive_command import drive
from viaspline.mission.sensor_spec import Lidar
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.ros_messages.message_book import standard_book

zenoh = pytest.importorskip("zenoh", reason="eclipse-zenoh is not installed")
BOOK = standard_book()
KINDS = {
    "/odom": "nav_msgs/msg/Odometry",
    "/scan": "sensor_msgs/msg/LaserScan",
    "/tf": "tf2_msgs/msg/TFMessage",
    "/tf_static": "tf2_msgs/msg/TFMessage",
}
LONGEST_PAUSE_S = 0.2  # a robot that lives by the clock tells where it was before that
MISSION = """
world: {known: [{circle: {center: [3, 2.1], radius: 0.3}}]}
robot: {radius_m: 0.3, clearance_m: 0.15, max_speed_mps: 1, tracking_error_m: 0.1,
        drive: {differential: {track_m: 0.4}, delay_s: 0.1},
        sensor: {lidar: {range_m: 4, fov_deg: 360, beams: 180}}}
route: {start: [1, 2], goal: [5, 2]}
"""


def key(topic: str) -> str:
    package, _, name = KINDS[topic].split("/")
    return f"0{topic}/{package}::msg::dds_::{name}_/{BOOK.hash(KINDS[topic])}"


class RobotThread(threading.Thread):
    """Lives by the clock on the wall, beside the command; notes how soon it is answered."""

    def __init__(self, endpoint: str) -> None:
        super().__init__(daemon=True)
        from ..links.ros.pretend_robot import PretendRobot

        post = Obstacle.model_validate({"circle": {"center": [3, 2.1], "radius": 0.3}})
        spec = Lidar.model_validate({"range_m": 4, "fov_deg": 360, "beams": 180})
        self.robot = PretendRobot([post], spec, (1.0, 2.0, 0.0))
        self.config = zenoh.Config()
        self.config.insert_json5("mode", json.dumps("client"))
        self.config.insert_json5("scouting/multicast/enabled", "false")
        self.config.insert_json5("connect/endpoints", json.dumps([endpoint]))
        self.over = threading.Event()
        self.answers: list[float] = []
        self.longest_pause = 0.0
        self.last: Any = None

    def run(self) -> None:
        robot, began = self.robot, time.monotonic()
        asked_at = [0.0]

        def told(sample: Any) -> None:
            now = time.monotonic()
            self.last = BOOK.decoded("geometry_msgs/msg/Twist", sample.payload.to_bytes())
            if asked_at[0]:
                self.answers.append(now - asked_at[0])
                asked_at[0] = 0.0
            robot.hears(now - began, self.last)

        with zenoh.open(self.config) as session:
            session.declare_subscriber("0/cmd_vel/geometry_msgs::msg::dds_::Twist_/*", told)
            tick, before = 0, 0.0
            while not self.over.is_set():
                now = time.monotonic() - began
                robot.moves(now, now - before)
                self.longest_pause = max(self.longest_pause, now - before)
                before, tick = now, tick + 1
                said = {"/odom": robot.odometry(now)}
                if tick % 10 == 1:
                    said["/tf"] = robot.map_to_odom(now)
                    said["/tf_static"] = robot.laser_mount(now)
                if tick % 2 == 0:
                    said["/scan"] = robot.scan(now)
                for topic, message in said.items():
                    if topic == "/scan":
                        asked_at[0] = time.monotonic()
                    session.put(key(topic), BOOK.encoded(KINDS[topic], message))
                self.over.wait(0.025)


@pytest.fixture
def endpoint() -> Any:
    """A zenoh router: its address."""
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        address = f"tcp/127.0.0.1:{one.getsockname()[1]}"
    config = zenoh.Config()
    config.insert_json5("mode", json.dumps("router"))
    config.insert_json5("scouting/multicast/enabled", "false")
    config.insert_json5("listen/endpoints", json.dumps([address]))
    with zenoh.open(config):
        yield address


def driven(endpoint: str, mission: Path) -> tuple[RobotThread, Any]:
    """A drive with the robot beside it, and what the command came to."""
    beside = RobotThread(endpoint)
    beside.start()
    try:
        done = CliRunner().invoke(cli, ["drive", str(mission), "--ros", "--connect", endpoint])
        time.sleep(0.1)
    finally:
        beside.over.set()
        beside.join()
    return beside, done


def test_a_robot_is_driven_over_real_sockets(endpoint: str, tmp_path: Path) -> None:
    (tmp_path / "yard.yaml").write_text(MISSION)
    for _ in range(3):
        beside, done = driven(endpoint, tmp_path / "yard.yaml")
        if beside.longest_pause < LONGEST_PAUSE_S:
            break
    else:
        pytest.skip(f"three times the robot's thread stood still for {LONGEST_PAUSE_S} s")
    assert done.exit_code == 0, done.output
    assert "the robot is at its goal" in done.output
    assert math.dist((beside.robot.x, beside.robot.y), (5, 2)) < 0.3
    assert beside.robot.nearest > 0.3
    assert beside.last["linear"]["x"] == 0.0
    assert len(beside.answers) > 20
    answers = sorted(beside.answers)
    print(f"scan to cmd_vel: median {1e3 * answers[len(answers) // 2]:.1f} ms, "
          f"p99 {1e3 * answers[int(0.99 * len(answers))]:.1f} ms of {len(answers)}")  # fmt: skip


def test_a_link_has_to_be_named(tmp_path: Path) -> None:
    (tmp_path / "yard.yaml").write_text(MISSION)
    done = CliRunner().invoke(drive, [f"{tmp_path}/yard.yaml"])
    assert done.exit_code == 2
    assert "--ros" in done.output


def test_a_mission_that_does_not_say_how_the_robot_drives_is_refused(tmp_path: Path) -> None:
    (tmp_path / "bare.yaml").write_text("route: {start: [0, 0], goal: [5, 0]}\n")
    done = CliRunner().invoke(cli, ["drive", f"{tmp_path}/bare.yaml", "--ros"])
    assert done.exit_code == 2
    assert "robot.drive" in done.output


def test_without_a_router_nothing_is_driven(tmp_path: Path) -> None:
    (tmp_path / "yard.yaml").write_text(MISSION)
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        port = one.getsockname()[1]
    done = CliRunner().invoke(
        cli, ["drive", f"{tmp_path}/yard.yaml", "--ros", "--connect", f"tcp/127.0.0.1:{port}", "-q"]
    )
    assert done.exit_code == 2
    assert "rmw_zenohd" in done.output
