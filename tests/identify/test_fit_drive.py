"""Drives with random truths: what is fitted to their logs is as near as its spread says."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.identify.drive_log import DriveLog, DriveLogError
from viaspline.identify.fit_drive import fit_drive
from viaspline.identify.identified_drive import IdentifiedDrive, drive_block
from viaspline.identify.simulated_log import simulated_log
from viaspline.identify.standard_drive import standard_commands
from viaspline.kernels.arrays import Floats
from viaspline.machine.allowance import allowance
from viaspline.machine.machine_limits import limits_of
from viaspline.machine.trial_drive import follow
from viaspline.mission.robot_parts import RobotSpec
from viaspline.trajectory.retime import retime

COMMANDS = standard_commands(1.0, 0.8, 0.05)
SPREADS = 4.0
"""So many spreads off is hardly ever anything; of some dozens of figures each."""


def robot(
    delay: float,
    lag: float,
    accel: float,
    slip: float = 0.0,
    wobble: float = 0.0,
    blur: float = 0.0,
) -> RobotSpec:
    return RobotSpec(
        max_speed_mps=1.0,
        max_accel_mps2=accel,
        drive={
            "differential": {"track_m": 0.5},
            "delay_s": delay,
            "lag_s": lag,
            "speed_noise_mps": slip,
            "yaw_rate_noise_degps": wobble,
        },
        localization={"position_noise_m": blur, "heading_noise_deg": 30.0 * blur},
    )


@settings(max_examples=3)
@given(
    delay=st.floats(0.0, 0.5),
    lag=st.floats(0.03, 0.6),
    accel=st.floats(0.3, 2.0),
    noise=st.tuples(st.floats(0.0, 0.05), st.floats(0.0, 3.0), st.floats(0.001, 0.03)),
    seed=st.integers(0, 10_000),
)
def test_the_truth_is_within_the_spread(
    delay: float, lag: float, accel: float, noise: tuple[float, float, float], seed: int
) -> None:
    found = fit_drive(simulated_log(robot(delay, lag, accel, *noise), COMMANDS, seed))
    for estimate, truth, slack in (
        (found.delay, delay, 0.01),
        (found.lag, lag, 0.01),
        (found.speed_share, 1.0, 0.01),
        (found.yaw_share, 1.0, 0.01),
        (found.speed_noise, noise[0], 0.01),
        (found.yaw_noise, math.radians(noise[1]), 0.01),
        (found.position_noise, noise[2], 0.002),
        (found.heading_noise, math.radians(30.0 * noise[2]), 0.002),
    ):
        assert abs(estimate.value - truth) <= SPREADS * estimate.spread + slack
    if found.accel is not None:
        assert abs(found.accel.value / (2.0 * accel) - 1.0) < 0.25


@pytest.fixture(scope="module")
def found() -> IdentifiedDrive:
    """Fitted to a drive without any noise."""
    return fit_drive(simulated_log(robot(0.23, 0.31, 0.5), COMMANDS))


def test_without_noise_it_is_found_to_a_hundredth(found: IdentifiedDrive) -> None:
    assert found.delay.value == pytest.approx(0.23, abs=0.01)
    assert found.lag.value == pytest.approx(0.31, abs=0.01)
    assert found.accel is not None
    assert found.accel.value == pytest.approx(1.0, rel=0.05)
    assert found.position_noise.value < 2e-3


def test_a_top_speed_that_commands_exceed_is_found() -> None:
    slow = robot(0.1, 0.1, 1.0).model_copy(update={"max_speed_mps": 0.7})
    found = fit_drive(simulated_log(slow, COMMANDS))
    assert found.top_speed is not None
    assert found.top_speed.value == pytest.approx(0.7, abs=0.01)


def test_a_limit_that_another_one_hides_is_found() -> None:
    """Fitted one after the other, an acceleration was taken for a lag of 0.4 s."""
    true = robot(0.0, 0.12, 0.35, 0.1).model_copy(update={"max_yaw_accel_degps2": 60.0})
    found = fit_drive(simulated_log(true, standard_commands(1.0, 1.5, 0.05)))
    assert found.lag.value == pytest.approx(0.12, abs=0.06)
    assert found.accel is not None
    assert found.accel.value == pytest.approx(0.7, rel=0.1)
    assert found.yaw_accel is not None
    assert math.degrees(found.yaw_accel.value) == pytest.approx(1.25 * 60.0, rel=0.1)
    assert "delay_s: 0  #" in drive_block(found, 0.5) or found.delay.value > 1e-3


def wheeled_log(accel: float, arm: float, lag: float, commands: Floats, seed: int = 0) -> DriveLog:
    """Of two wheels with motors that end, reckoned step by step, poses with a noise of 2 mm."""
    step, chance = 0.001, np.random.default_rng(seed)
    x = y = heading = 0.0
    left = right = 0.0
    rows = []
    for _, speed, rate in commands:
        rows.append((x, y, heading))
        for _ in range(round((commands[1, 0] - commands[0, 0]) / step)):
            asked = (speed - arm * rate - left) / lag, (speed + arm * rate - right) / lag
            left, right = (
                one + step * min(max(change, -accel), accel)
                for one, change in zip((left, right), asked, strict=True)
            )
            heading += step * (right - left) / (2.0 * arm)
            x += step * 0.5 * (left + right) * math.cos(heading)
            y += step * 0.5 * (left + right) * math.sin(heading)
    places = np.array(rows) + chance.normal(0.0, (0.002, 0.002, 0.001), (len(rows), 3))
    return DriveLog(commands[:, 0], *places.T, commands[:, 1], commands[:, 2])


@settings(max_examples=2)
@given(
    accel=st.floats(0.6, 3.0),
    arm=st.floats(0.06, 0.3),
    lag=st.floats(0.04, 0.3),
    seed=st.integers(0, 10_000),
)
def test_a_robot_that_does_not_turn_while_its_wheels_speed_up_has_no_noise(
    accel: float, arm: float, lag: float, seed: int
) -> None:
    """What its motors hadn't left to turn with was taken for a noise of 8 degrees a second."""
    commands = standard_commands(1.0, 1.5, 0.05)
    found = fit_drive(wheeled_log(accel, arm, lag, commands, seed))
    assert math.degrees(sum(found.yaw_noise)) < 1.5
    assert abs(found.lag.value - lag) <= SPREADS * found.lag.spread + 0.01
    if found.accels_are_shared:
        assert found.accel is not None
        assert found.yaw_accel is not None
        assert found.accel.value == pytest.approx(accel, rel=0.1)
        assert found.yaw_accel.value == pytest.approx(accel / arm, rel=0.25)


def car(wheelbase: float, lock: float, rate: float | None, delay: float) -> RobotSpec:
    steered = {
        "wheelbase_m": wheelbase, "max_steer_deg": lock, "max_steer_rate_degps": rate,
    }  # fmt: skip
    return RobotSpec(
        max_speed_mps=2.0,
        drive={"ackermann": steered, "delay_s": delay, "lag_s": 0.1, "yaw_rate_noise_degps": 0.3},
        localization={"position_noise_m": 0.004, "heading_noise_deg": 0.2},
    )


@settings(max_examples=2)
@given(
    wheelbase=st.floats(0.3, 2.5),
    lock=st.floats(18.0, 38.0),
    rate=st.one_of(st.none(), st.floats(25.0, 60.0)),
    delay=st.floats(0.0, 0.4),
    asked=st.sampled_from((0.75, 1.15)),
    seed=st.integers(0, 10_000),
)
def test_of_a_car_no_sharper_turn_is_said_than_its_lock_allows(
    wheelbase: float, lock: float, rate: float | None, delay: float, asked: float, seed: int
) -> None:
    """Whether it was told to turn more tightly than that, or never as tightly."""
    true = car(wheelbase, lock, rate, delay)
    assert true.turn_radius is not None
    commands = standard_commands(2.0, 20.0, 0.05, asked * true.turn_radius)
    found = fit_drive(simulated_log(true, commands, seed), wheelbase=wheelbase)
    assert found.steering is not None
    assert found.yaw_accel is None
    assert math.degrees(found.steering.widest) < lock + 0.6
    if asked < 1.0 and rate is None:
        assert found.steering.most is not None
        assert math.degrees(found.steering.most.value) == pytest.approx(lock, abs=1.0)
    if rate is not None:
        assert found.steering.rate is not None
        assert math.degrees(found.steering.rate.value) == pytest.approx(rate, rel=0.15)
    assert abs(found.delay.value - delay) <= SPREADS * found.delay.spread + 0.02


def test_a_car_that_slips_out_of_its_turns_steers_less_than_it_is_told() -> None:
    commands = standard_commands(2.0, 20.0, 0.05, 4.0)
    log = simulated_log(car(1.2, 35.0, None, 0.1), commands, seed=2)
    less = DriveLog(
        log.times, log.x, log.y, log.headings, log.speeds, log.yaw_rates / 0.8,
    )  # fmt: skip
    found = fit_drive(less, wheelbase=1.2)
    assert found.yaw_share.value == pytest.approx(0.8, abs=0.02)
    assert found.steering is not None
    assert math.tan(found.steering.widest) == pytest.approx(1.2 / 4.0, rel=0.05)
    text = drive_block(found, 0.5)
    assert "ackermann:" in text
    assert "give it 1.2" in text


def test_what_the_wheels_share_is_said_with_the_keys() -> None:
    found = fit_drive(wheeled_log(1.2, 0.2, 0.1, standard_commands(1.0, 1.5, 0.05)))
    assert found.accels_are_shared
    text = drive_block(found, 0.4)
    assert "max_accel_mps2: 0.6" in text
    assert "the other half of its wheels' is the speed's" in text


def test_limits_that_are_apart_are_not_taken_for_those_of_wheels(found: IdentifiedDrive) -> None:
    assert not found.accels_are_shared


def test_the_greatest_yaw_rate_that_was_driven_is_a_limit_to_paste(found: IdentifiedDrive) -> None:
    """Without one a cart was told to turn at 10 rad/s in a sharp bend, and never got round it."""
    assert found.fastest_turn == pytest.approx(0.8, rel=0.02)
    assert f"max_yaw_rate_degps: {math.degrees(found.fastest_turn) / 1.25:.3g}" in drive_block(
        found, 0.5
    )


def test_slip_is_told_from_a_yaw_rate_that_is_not_reached() -> None:
    log = simulated_log(robot(0.1, 0.1, 1.0, 0.01, 0.5, 0.003), COMMANDS, seed=3)
    slipping = DriveLog(
        log.times, log.x, log.y, log.headings, log.speeds, log.yaw_rates / (1.0 - 0.3)
    )
    found = fit_drive(slipping)
    assert found.yaw_share.value == pytest.approx(0.7, abs=0.02)
    assert "skid_steer: {track_m: 0.6, slip: 0.3" in drive_block(found, 0.6)


@pytest.mark.parametrize("seed", range(2))
def test_the_allowance_of_the_identified_drive_covers_the_true_one(seed: int) -> None:
    chance = np.random.default_rng(seed)
    true = robot(
        chance.uniform(0.0, 0.4), chance.uniform(0.05, 0.5), 0.8, chance.uniform(0.0, 0.04),
        chance.uniform(0.0, 2.0), chance.uniform(0.001, 0.02),
    )  # fmt: skip
    found = fit_drive(simulated_log(true, COMMANDS, seed))
    named = robot(
        found.delay.value, found.lag.value, 0.8, sum(found.speed_noise),
        math.degrees(sum(found.yaw_noise)), sum(found.position_noise),
    )  # fmt: skip
    path = CardinalSpline(
        np.array([[0, 0], [6, 2], [10, -2], [16, 3], [22, 0]]), knots="chordal",
        tangents="continuous",
    )  # fmt: skip
    law = retime(path, limits_of(named))
    kept = allowance(path, law, named)
    for drive in range(4):
        track = follow(path, law, true, seed=100 + drive)
        assert track.finished
        assert track.tracking.body_deviation(0.0) <= kept


def test_a_log_that_shows_too_little_is_refused_with_what_would_do() -> None:
    t = np.arange(0.0, 20.0, 0.05)
    still = DriveLog(t, 0 * t, 0 * t, 0 * t, 0 * t, 0 * t)
    with pytest.raises(DriveLogError, match="identify --drive"):
        fit_drive(still)
    straight = DriveLog(t, t, 0 * t, 0 * t, 1.0 + 0.1 * np.sin(t), 0 * t)
    with pytest.raises(DriveLogError, match="too little"):
        fit_drive(straight)


def test_what_does_not_follow_from_the_commands_is_refused() -> None:
    log = simulated_log(robot(0.1, 0.1, 1.0), COMMANDS)
    chance = np.random.default_rng(1)
    other = DriveLog(
        log.times, log.x, log.y, log.headings, chance.uniform(-1, 1, len(log.times)),
        chance.uniform(-1, 1, len(log.times)),
    )  # fmt: skip
    with pytest.raises(DriveLogError, match="doesn't follow from its commands"):
        fit_drive(other)


def test_the_same_log_gives_the_same_figures() -> None:
    seldom = standard_commands(1.0, 0.8, 0.15)
    log = simulated_log(robot(0.1, 0.2, 1.0, 0.02, 1.0, 0.01), seldom, seed=5)
    assert fit_drive(log) == fit_drive(log)
