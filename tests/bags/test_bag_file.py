"""Bags as others read them: mcap_ros2 and rosbags, and shapely for what a map shows."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from mcap.reader import make_reader
from mcap_ros2.decoder import DecoderFactory
from rosbags.highlevel import AnyReader
from rosbags.typesys import Stores, get_typestore

import viaspline as vs
from viaspline.bags import bag_writer
from viaspline.bags.bag_file import BagFile
from viaspline.robot.run import Run
from viaspline.robot.simulation.driven_step import DrivenStep

Recorded = Callable[[str], tuple[Path, Run]]
TYPES = {
    "/tf": "tf2_msgs/msg/TFMessage",
    "/tf_static": "tf2_msgs/msg/TFMessage",
    "/odom": "nav_msgs/msg/Odometry",
    "/plan": "nav_msgs/msg/Path",
    "/cmd_vel": "geometry_msgs/msg/Twist",
    "/map": "nav_msgs/msg/OccupancyGrid",
    "/viaspline/markers": "visualization_msgs/msg/MarkerArray",
    "/rosout": "rcl_interfaces/msg/Log",
}


def by_mcap(path: Path) -> dict[str, list[tuple[float, Any]]]:
    """The messages of each topic as mcap_ros2 reads them, with their times [s]."""
    found: dict[str, list[tuple[float, Any]]] = {}
    with path.open("rb") as file:
        for schema, channel, message, value in make_reader(
            file, validate_crcs=True, decoder_factories=[DecoderFactory()]
        ).iter_decoded_messages():
            assert schema is not None
            assert schema.encoding == "ros2msg"
            assert channel.message_encoding == "cdr"
            found.setdefault(channel.topic, []).append((message.log_time / 1e9, value))
    return found


def by_rosbags(path: Path) -> dict[str, list[tuple[float, Any]]]:
    """The messages of each topic as rosbags reads them, with their times [s]."""
    found: dict[str, list[tuple[float, Any]]] = {}
    with AnyReader([path], default_typestore=get_typestore(Stores.ROS2_HUMBLE)) as reader:
        for connection, time, data in reader.messages():
            value = reader.deserialize(data, connection.msgtype)
            found.setdefault(connection.topic, []).append((time / 1e9, value))
    return found


@pytest.fixture(params=[by_mcap, by_rosbags])
def read(request: pytest.FixtureRequest) -> Callable[[Path], dict[str, list[tuple[float, Any]]]]:
    """Another's reader."""
    return request.param  # type: ignore[no-any-return]


@pytest.mark.parametrize("name", ["exact", "lidar", "driven", "moving"])
def test_others_read_every_message(recorded: Recorded, read: Any, name: str) -> None:
    path, run = recorded(name)
    topics = read(path)
    assert set(TYPES) <= set(topics)
    assert ("/scan" in topics) == (name == "lidar")
    for messages in topics.values():
        times = [time for time, _ in messages]
        assert times == sorted(times)
    assert len(topics["/rosout"]) == sum(1 for event in run.events if event.kind != "contact")


def test_the_poses_are_where_the_robot_was(recorded: Recorded, read: Any) -> None:
    for name, error in (("exact", 1e-6), ("driven", 1e-3)):
        path, run = recorded(name)
        topics = read(path)
        for (time, odometry), (_, frames) in zip(topics["/odom"], topics["/tf"], strict=True):
            at = odometry.pose.pose.position
            assert np.hypot(*(np.array(run.place_at(time)) - (at.x, at.y))) <= error + 0.02
            (frame,) = frames.transforms
            assert (frame.header.frame_id, frame.child_frame_id) == ("odom", "base_link")
            moved = frame.transform.translation
            assert (moved.x, moved.y) == (at.x, at.y)
            assert frame.header.stamp.sec + frame.header.stamp.nanosec / 1e9 == pytest.approx(time)


def test_the_commands_lead_to_the_speeds_that_were_driven(recorded: Recorded, read: Any) -> None:
    path, run = recorded("driven")
    topics = read(path)
    told = np.array([value.linear.x for _, value in topics["/cmd_vel"]])
    went = np.array([value.twist.twist.linear.x for _, value in topics["/odom"]])
    later = 2  # steps: the delay of the drive
    assert np.abs(told[:-later] - went[later:]).max() < 0.06
    assert told[-1] == pytest.approx(0.0, abs=0.02)
    turned = np.array([value.twist.twist.angular.z for _, value in topics["/odom"]])
    steered = np.array([value.angular.z for _, value in topics["/cmd_vel"]])
    assert np.corrcoef(steered[:-later], turned[later:])[0, 1] > 0.9
    assert run.reached


def test_the_map_shows_what_is_known(recorded: Recorded, read: Any) -> None:
    path, _ = recorded("exact")
    ((_, grid),) = read(path)["/map"]
    info = grid.info
    cells = np.array(grid.data).reshape(info.height, info.width)
    columns, rows = np.meshgrid(np.arange(info.width), np.arange(info.height))
    x = info.origin.position.x + (columns + 0.5) * info.resolution
    y = info.origin.position.y + (rows + 0.5) * info.resolution
    away = shapely.distance(shapely.points(x, y), shapely.Point(15, 0.5)) - 2.0
    edge = np.minimum.reduce([x + 5, 55 - x, y + 15, 15 - y])
    away = np.minimum(away, edge)
    assert (cells[away > 0.51 * info.resolution] == 0).all()
    assert (cells[away < 0.49 * info.resolution] == 100).all()
    assert set(np.unique(cells)) == {0, 100}


def test_a_scan_is_what_the_lidar_saw(recorded: Recorded, read: Any) -> None:
    path, _ = recorded("lidar")
    topics = read(path)
    for (_, scan), (_, step) in zip(topics["/scan"], topics["/viaspline/step"], strict=True):
        (exact,) = step.scan
        np.testing.assert_array_equal(np.float32(exact.ranges), np.float32(scan.ranges))
        beams = round((scan.angle_max - scan.angle_min) / scan.angle_increment) + 1
        assert beams == len(scan.ranges) == 90
        assert scan.range_max == 5.0


def test_a_path_is_told_when_there_is_a_new_one(recorded: Recorded, read: Any) -> None:
    path, run = recorded("exact")
    topics = read(path)
    assert len(topics["/plan"]) == 1 + len(run.replans) >= 2
    points = np.array(
        [(p.pose.position.x, p.pose.position.y) for p in topics["/plan"][-1][1].poses]
    )
    where = np.asarray(run.path.spans)[..., :2].reshape(-1, 2)
    assert points[0] == pytest.approx(where[0])
    assert points[-1] == pytest.approx(where[-1])
    line = shapely.LineString(points)
    assert max(line.distance(shapely.Point(*p)) for p in run.positions) < 0.02


def test_marks_show_detours_sides_certificate_and_events(recorded: Recorded, read: Any) -> None:
    path, run = recorded("exact")
    marks = [m for _, array in read(path)["/viaspline/markers"] for m in array.markers]
    spaces = {m.ns for m in marks}
    assert {"detours", "sides", "certificate", "events"} <= spaces
    words = [m.text for m in marks if m.ns == "events"]
    assert words == [event.message for event in run.events]
    assert any("m clear of tank" in m.text for m in marks if m.ns == "certificate")
    assert marks[0].action == 3


def test_the_same_drive_gives_the_same_bytes(recorded: Recorded, tmp_path: Path) -> None:
    path, run = recorded("lidar")
    with BagFile(tmp_path / "again.mcap").recording(run.plan.mission, run.plan, seed=3) as watch:
        vs.simulate(run.plan.mission, plan=run.plan, seed=3, watch=watch)
    assert (tmp_path / "again.mcap").read_bytes() == path.read_bytes()


def test_topics_that_stay_are_offered_to_who_comes_later(recorded: Recorded) -> None:
    path, _ = recorded("exact")
    with path.open("rb") as file:
        summary = make_reader(file).get_summary()
    assert summary is not None
    for channel in summary.channels.values():
        stays = channel.topic in ("/map", "/tf_static", "/plan", "/viaspline/markers")
        assert ("durability: 1" in channel.metadata["offered_qos_profiles"]) == stays
    assert [a.name for a in summary.attachment_indexes] == ["mission.json"]


def test_a_bag_that_cannot_be_written_is_refused_before_the_work(tmp_path: Path) -> None:
    with pytest.raises(vs.OutputError, match=r"ends in \.mcap"):
        BagFile(tmp_path / "run.bag")
    (tmp_path / "file").write_text("")
    with pytest.raises(vs.OutputError, match="another folder"):
        BagFile(tmp_path / "file" / "run.mcap")
    (tmp_path / "run.mcap").mkdir()
    with pytest.raises(vs.OutputError, match="is a folder"):
        BagFile(tmp_path / "run.mcap")


def test_without_the_extra_it_is_said_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(bag_writer, "find_spec", lambda name: None)
    with pytest.raises(vs.OutputError, match=r"pip install 'viaspline\[bags\]'"):
        BagFile(tmp_path / "run.mcap")


def test_a_drive_that_fails_leaves_no_bag(tmp_path: Path) -> None:
    mission = vs.Mission.model_validate({"route": {"start": [0, 0], "goal": [9, 0]}})
    plan = vs.plan(mission)
    assert isinstance(plan, vs.Plan)

    def interrupted(step: DrivenStep) -> None:
        raise KeyboardInterrupt

    def drive() -> None:
        with BagFile(tmp_path / "run.mcap").recording(mission, plan):
            vs.simulate(mission, plan=plan, watch=interrupted)

    with pytest.raises(KeyboardInterrupt):
        drive()
    assert not list(tmp_path.iterdir())
