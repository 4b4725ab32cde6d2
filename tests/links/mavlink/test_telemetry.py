"""What a vehicle has said, and whether that is enough to drive it."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from viaspline.formats.local_frame import LocalFrame
from viaspline.links.mavlink.common_messages import (
    Attitude,
    CommandAck,
    EkfStatusReport,
    EstimatorStatus,
    GlobalPositionInt,
    Heartbeat,
    Statustext,
)
from viaspline.links.mavlink.message import MavlinkMessage
from viaspline.links.mavlink.telemetry import Telemetry
from viaspline.links.mavlink.vehicle_state import VehicleState, heading_of, vehicle_state

GOOD = 1 | 2 | 8 | 16
HERE = GlobalPositionInt(0, 471000000, 82000000, 400000, 0, 0, 0, 0, 0)
NORTH = Attitude(0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)


def ekf(flags: int) -> EkfStatusReport:
    return EkfStatusReport(0.0, 0.0, 0.0, 0.0, 0.0, flags, 0.0)


def after(*messages: MavlinkMessage) -> Telemetry:
    telemetry = Telemetry()
    for k, message in enumerate(messages):
        telemetry = telemetry.heard(message, float(k))
    return telemetry


def test_nothing_said_is_nothing_known() -> None:
    assert len(Telemetry().not_ready) == 3
    assert not Telemetry().is_armed
    assert Telemetry().mode is None
    assert Telemetry().pose_at == -math.inf


def test_all_said_is_ready_with_either_kind_of_report() -> None:
    assert after(ekf(GOOD), NORTH, HERE).not_ready == ()
    px4 = EstimatorStatus(0, *([0.0] * 8), GOOD | 1024)  # of PX4 that bit is another one
    assert after(px4, NORTH, HERE).not_ready == ()


@given(flags=st.integers(0, 2047))
def test_an_ekf_is_ready_with_attitude_velocity_and_a_position_that_is_not_made_up(
    flags: int,
) -> None:
    is_good = bool(flags & 1 and flags & 2 and flags & 24 and not flags & (128 | 1024))
    assert (after(ekf(flags), NORTH, HERE).not_ready == ()) == is_good


def test_the_older_half_of_a_pose_counts() -> None:
    telemetry = after(Heartbeat(15, 10, 3, 129, 4, 3), NORTH, HERE)
    assert (telemetry.pose_at, telemetry.last_at, telemetry.beat_at) == (1.0, 2.0, 0.0)
    assert telemetry.is_armed
    assert telemetry.mode == 15


def test_words_and_refusals_are_told() -> None:
    text = Statustext(2, b"PreArm:  bad\x1b[31m compass".ljust(50, b"\0"), 0, 0)
    refused = CommandAck(400, 4, 0, 0, 245, 190)
    reason = after(text, refused).reason
    assert reason == " (to be armed: failed; it says “PreArm: bad[31m compass”)"
    assert after(CommandAck(400, 0, 0, 0, 245, 190)).reason == ""


@pytest.mark.parametrize(
    ("yaw", "heading"),
    [(0.0, math.pi / 2), (math.pi / 2, 0.0), (math.pi, -math.pi / 2), (-math.pi / 2, math.pi)],
)
def test_a_yaw_is_clockwise_from_north_and_a_heading_anticlockwise_from_east(
    yaw: float, heading: float
) -> None:
    assert math.remainder(heading_of(yaw) - heading, math.tau) == pytest.approx(0.0, abs=1e-12)
    assert math.remainder(heading_of(heading_of(yaw)) - yaw, math.tau) == pytest.approx(
        0.0, abs=1e-12
    )


@given(
    yaw=st.floats(-math.pi, math.pi),
    along=st.integers(-300, 300),
    right=st.integers(-300, 300),
    age=st.floats(0, 0.5),
)
def test_speeds_are_turned_into_the_body_and_the_place_is_moved_on(
    yaw: float, along: int, right: int, age: float
) -> None:
    north = along * math.cos(yaw) - right * math.sin(yaw)
    east = along * math.sin(yaw) + right * math.cos(yaw)
    position = GlobalPositionInt(0, 471000000, 82000000, 0, 2500, round(north), round(east), -50, 0)
    telemetry = Telemetry(
        position=position, position_at=10.0, attitude=Attitude(0, 0, 0, yaw, 0, 0, 0.0),
        attitude_at=10.0,
    )  # fmt: skip
    state = vehicle_state(telemetry, LocalFrame(47.1, 8.2), 10.0 + age)
    assert isinstance(state, VehicleState)
    assert state.speed == pytest.approx(along / 100, abs=0.011)
    assert state.across == pytest.approx(-right / 100, abs=0.011)
    assert state.x == pytest.approx(age * round(east) / 100, abs=1e-6)
    assert state.y == pytest.approx(age * round(north) / 100, abs=1e-6)
    assert state.up == pytest.approx(2.5 + 0.5 * age)
    assert state.climb == 0.5
