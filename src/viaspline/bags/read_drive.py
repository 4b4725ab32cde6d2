"""A drive as others recorded it: where the robot was when, and what it was told to do."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np

from viaspline.bags.raw_message import BagExtent, MessageDecoder, RawMessage
from viaspline.bags.rosbag2_reader import read_bag
from viaspline.errors import BagError, MessageError
from viaspline.kernels.arrays import Floats
from viaspline.ros_messages.pose_message import heading_of
from viaspline.ros_messages.stamps import seconds_of

ODOMETRY: Final = "nav_msgs/msg/Odometry"
TWIST: Final = "geometry_msgs/msg/Twist"
TWIST_STAMPED: Final = "geometry_msgs/msg/TwistStamped"
COMMANDS: Final = (TWIST, TWIST_STAMPED)
USUAL_ODOMETRY: Final = ("/odom", "/odometry/filtered", "/odometry")
USUAL_COMMANDS: Final = ("/cmd_vel", "/cmd_vel_smoothed", "/cmd_vel_nav")
OTHER_CLOCK_S: Final = 1.0
"""Stamps that are farther than this from when messages were written down are by another clock."""


@dataclass(frozen=True, eq=False)
class RecordedDrive:
    """What a bag says of a drive; all times by one clock.

    Attributes:
        times: When the robot was where [s], shape (n,), ever later.
        poses: x, y [m] and heading [rad], shape (n, 3).
        speeds: Along and across the body [m/s], and its yaw rate [rad/s], shape (n, 3).
        command_times: When it was told what to do [s], shape (m,), never earlier.
        commands: Along and across the body [m/s], and the yaw rate [rad/s], shape (m, 3).
        odometry_topic: Where the poses come from.
        command_topic: Where the commands come from.
        damage: Why the bag ends before its end; None: it doesn't.
    """

    times: Floats
    poses: Floats
    speeds: Floats
    command_times: Floats
    commands: Floats
    odometry_topic: str
    command_topic: str
    damage: str | None = None


def read_drive(
    path: str | Path, *, odometry: str | None = None, commands: str | None = None
) -> RecordedDrive:
    """Read where a robot was and what it was told to do, from an MCAP file or a rosbag2.

    A ``Twist`` has no stamp: it counts from when it was written down, less what lies between that
    and the stamps of the odometry where those are by another clock (that of a simulator).

    Args:
        path: The bag.
        odometry: The topic of ``nav_msgs/Odometry``; None: the usual one, or the only one.
        commands: The topic of ``geometry_msgs/Twist`` or ``TwistStamped``; None: likewise.

    Raises:
        BagError: It can't be read, or hasn't one such topic with two messages at least.
        OutputError: The extra ``bags`` is needed and isn't installed.
    """
    path = Path(path)
    extent, decoder = BagExtent(), MessageDecoder()
    raw: dict[str, list[RawMessage]] = {}
    for message in read_bag(path, lambda _, kind: kind in (ODOMETRY, *COMMANDS), extent):
        raw.setdefault(message.topic, []).append(message)
    chosen = _Chosen(path, extent.topics, raw)
    poses_from = chosen.topic(odometry, (ODOMETRY,), USUAL_ODOMETRY, "odometry")
    commands_from = chosen.topic(commands, COMMANDS, USUAL_COMMANDS, "commands")
    try:
        rows, offset = _odometry_rows(raw[poses_from], decoder)
        told = _command_rows(raw[commands_from], decoder, offset)
    except MessageError as error:
        raise BagError(path, str(error)) from error
    rows = _ever_later(rows)
    told = told[np.argsort(told[:, 0], kind="stable")]
    for topic, found in ((poses_from, rows), (commands_from, told)):
        if len(found) < 2 or not np.isfinite(found).all():
            problem = (
                "has fewer than two moments" if len(found) < 2 else "has numbers that are none"
            )
            raise BagError(path, f"its topic {topic} {problem}; record a whole drive")
    return RecordedDrive(
        rows[:, 0], rows[:, 1:4], rows[:, 4:], told[:, 0], told[:, 1:], poses_from, commands_from,
        extent.damage,
    )  # fmt: skip


@dataclass(frozen=True)
class _Chosen:
    """Which of a bag's topics are read."""

    path: Path
    topics: Mapping[str, str]
    raw: Mapping[str, Sequence[RawMessage]]

    def topic(
        self, asked: str | None, kinds: Sequence[str], usual: Sequence[str], what: str
    ) -> str:
        found = [topic for topic, kind in self.topics.items() if kind in kinds]
        full = [topic for topic in found if topic in self.raw]
        if asked is not None:
            if asked in full:
                return asked
            has = f"; it has {', '.join(found)}" if found else ""
            raise BagError(self.path, f"has no {what} on {asked}{has}")
        for name in usual:
            if name in full:
                return name
        if len(full) == 1:
            return full[0]
        if not full:
            names = " or ".join(kinds)
            raise BagError(self.path, f"holds no {what} ({names}); record it, too")
        raise BagError(self.path, f"has {what} on {', '.join(full)}; choose one with --{what}")


def _odometry_rows(messages: Sequence[RawMessage], decoder: MessageDecoder) -> tuple[Floats, float]:
    """Time, pose and speeds of every message, and how much later it was written down [s]."""
    rows, stamped = [], False
    logged = np.array([message.time for message in messages])
    for message in messages:
        one = decoder.read(message)
        pose, twist = one["pose"]["pose"], one["twist"]["twist"]
        time = seconds_of(one["header"]["stamp"])
        stamped = stamped or time > 0.0
        place = pose["position"]
        rows.append(
            (time, place["x"], place["y"], heading_of(pose["orientation"]), *_speeds(twist))
        )
    found = np.array(rows, np.float64).reshape(-1, 7)
    found[:, 3] = np.unwrap(found[:, 3])
    if not stamped:
        found[:, 0] = logged
    lag = float(np.median(logged - found[:, 0]))
    return found, lag if abs(lag) > OTHER_CLOCK_S else 0.0


def _command_rows(messages: Sequence[RawMessage], decoder: MessageDecoder, offset: float) -> Floats:
    rows = []
    for message in messages:
        one = decoder.read(message)
        time = message.time - offset
        if message.kind == TWIST_STAMPED:
            stamp = seconds_of(one["header"]["stamp"])
            time, one = (stamp if stamp > 0.0 else time), one["twist"]
        rows.append((time, *_speeds(one)))
    return np.array(rows, np.float64).reshape(-1, 4)


def _speeds(twist: Mapping[str, Any]) -> tuple[float, float, float]:
    return twist["linear"]["x"], twist["linear"]["y"], twist["angular"]["z"]


def _ever_later(rows: Floats) -> Floats:
    """Rows in the order of their times, one for each."""
    ordered = rows[np.argsort(rows[:, 0], kind="stable")]
    later = np.ones(len(ordered), bool)
    later[1:] = np.diff(ordered[:, 0]) > 0.0
    return ordered[later]
