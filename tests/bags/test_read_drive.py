"""Drives of others: made by rosbags, as MCAP and as SQLite."""

import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from viaspline.bags.read_drive import RecordedDrive, read_drive
from viaspline.errors import BagError
from viaspline.robot.run import Run

STORE = get_typestore(Stores.ROS2_HUMBLE)
TIMES = np.arange(0.0, 5.0, 0.05)
HEADINGS = 3.0 + 0.2 * TIMES  # past half a turn


def _message(name: str, **values: Any) -> Any:
    return STORE.types[name](**values)


def _header(time: float) -> Any:
    sec, nanosec = divmod(round(time * 1e9), 10**9)
    stamp = _message("builtin_interfaces/msg/Time", sec=sec, nanosec=nanosec)
    return _message("std_msgs/msg/Header", stamp=stamp, frame_id="odom")


def _twist(along: float, turn: float) -> Any:
    vector = STORE.types["geometry_msgs/msg/Vector3"]
    return _message(
        "geometry_msgs/msg/Twist", linear=vector(along, 0.0, 0.0), angular=vector(0.0, 0.0, turn)
    )


def _odometry(time: float, heading: float) -> Any:
    none = np.zeros(36)
    pose = _message(
        "geometry_msgs/msg/Pose",
        position=_message("geometry_msgs/msg/Point", x=time, y=-time, z=0.0),
        orientation=_message(
            "geometry_msgs/msg/Quaternion",
            x=0.0, y=0.0, z=np.sin(heading / 2), w=np.cos(heading / 2),
        ),
    )  # fmt: skip
    return _message(
        "nav_msgs/msg/Odometry",
        header=_header(time),
        child_frame_id="base_link",
        pose=_message("geometry_msgs/msg/PoseWithCovariance", pose=pose, covariance=none),
        twist=_message(
            "geometry_msgs/msg/TwistWithCovariance", twist=_twist(0.5 * time, 0.2), covariance=none
        ),
    )


def record(
    folder: Path,
    *,
    storage: StoragePlugin = StoragePlugin.MCAP,
    odometry: tuple[str, ...] = ("/odom",),
    commands: tuple[str, ...] = ("/cmd_vel",),
    stamped: bool = False,
    behind: float = 0.0,
    version: int = 8,
) -> Path:
    """A bag of another's: odometry with stamps, written down so much later, and commands."""
    kind = "geometry_msgs/msg/TwistStamped" if stamped else "geometry_msgs/msg/Twist"
    with Writer(folder, version=version, storage_plugin=storage) as writer:  # type: ignore[arg-type]
        poses = [
            writer.add_connection(topic, "nav_msgs/msg/Odometry", typestore=STORE)
            for topic in odometry
        ]
        told = [writer.add_connection(topic, kind, typestore=STORE) for topic in commands]
        for time, heading in zip(TIMES.tolist(), HEADINGS.tolist(), strict=True):
            logged = round((time + behind) * 1e9)
            for one in poses:
                data = STORE.serialize_cdr(_odometry(time, heading), one.msgtype)
                writer.write(one, logged, data)
            for one in told:
                twist = _twist(time, 0.1)
                if stamped:
                    twist = _message(kind, header=_header(time), twist=twist)
                writer.write(one, logged, STORE.serialize_cdr(twist, one.msgtype))
    return folder


@pytest.mark.parametrize("storage", [StoragePlugin.MCAP, StoragePlugin.SQLITE3])
@pytest.mark.parametrize("stamped", [False, True])
@pytest.mark.parametrize("version", [8, 9])
@pytest.mark.parametrize("behind", [0.003, 1.7e9])
def test_a_drive_of_another_is_read(
    tmp_path: Path, storage: StoragePlugin, stamped: bool, version: int, behind: float
) -> None:
    bag = record(tmp_path / "a", storage=storage, stamped=stamped, behind=behind, version=version)
    drive = read_drive(bag)
    np.testing.assert_allclose(drive.times, TIMES, atol=1e-6)
    np.testing.assert_allclose(drive.poses[:, 0], TIMES)
    np.testing.assert_allclose(drive.poses[:, 1], -TIMES)
    np.testing.assert_allclose(drive.poses[:, 2], HEADINGS)
    np.testing.assert_allclose(drive.speeds[:, 0], 0.5 * TIMES)
    np.testing.assert_allclose(drive.speeds[:, 2], 0.2)
    np.testing.assert_allclose(drive.command_times, TIMES, atol=0.004)
    np.testing.assert_allclose(drive.commands, np.column_stack((TIMES, 0 * TIMES, 0 * TIMES + 0.1)))
    assert (drive.odometry_topic, drive.command_topic) == ("/odom", "/cmd_vel")


def test_our_own_bag_is_read_as_well(
    recorded: Callable[[str], tuple[Path, Run]],
) -> None:
    path, run = recorded("driven")
    drive = read_drive(path)
    assert drive.damage is None
    assert len(drive.times) == len(drive.command_times)
    places = [run.place_at(float(time)) for time in drive.times]
    assert np.hypot(*(drive.poses[:, :2] - np.array(places)).T).max() < 0.02


def test_topics_are_chosen_or_asked_for(tmp_path: Path) -> None:
    bag = record(tmp_path / "a", odometry=("/wheels", "/imu"), commands=("/drive",))
    with pytest.raises(BagError, match="has odometry on /wheels, /imu; choose one with --odometry"):
        read_drive(bag)
    drive = read_drive(bag, odometry="/imu")
    assert (drive.odometry_topic, drive.command_topic) == ("/imu", "/drive")
    with pytest.raises(BagError, match="no commands on /cmd_vel; it has /drive"):
        read_drive(bag, odometry="/imu", commands="/cmd_vel")
    usual = read_drive(record(tmp_path / "b", odometry=("/wheels", "/odom")))
    assert usual.odometry_topic == "/odom"


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"odometry": ()}, "holds no odometry"),
        ({"commands": ()}, "holds no commands"),
    ],
)
def test_what_a_bag_lacks_is_named(more: dict[str, Any], words: str, tmp_path: Path) -> None:
    with pytest.raises(BagError, match=words):
        read_drive(record(tmp_path / "a", **more))


def test_a_database_that_is_none_or_cut_is_told(tmp_path: Path) -> None:
    (tmp_path / "a.db3").write_bytes(b"nothing of the sort, " * 100)
    with pytest.raises(BagError, match="a rosbag2 database"):
        read_drive(tmp_path / "a.db3")
    bag = record(tmp_path / "b", storage=StoragePlugin.SQLITE3)
    (file,) = bag.glob("*.db3")
    data = file.read_bytes()
    for part in (0.1, 0.5, 0.9):
        file.write_bytes(data[: int(part * len(data))])
        try:
            drive: RecordedDrive | None = read_drive(bag)
        except BagError:
            drive = None
        assert drive is None or drive.damage is not None


def test_an_mcap_that_is_cut_short_is_read_as_far_as_it_is_whole(tmp_path: Path) -> None:
    bag = record(tmp_path / "a")
    (file,) = bag.glob("*.mcap")
    file.write_bytes(file.read_bytes()[:-60])
    assert read_drive(bag).damage is not None
    shutil.copy(file, tmp_path / "one.mcap")
    assert len(read_drive(tmp_path / "one.mcap").times) == len(TIMES)
