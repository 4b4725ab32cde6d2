"""Following a path in a closed loop: it comes back, in spite of delay, lag, limits and noise."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.machine.machine_limits import limits_of
from viaspline.machine.trial_drive import Track, follow
from viaspline.machine.turns_on_spot import with_turns
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.spot_turning import SpotTurning
from viaspline.trajectory.retime import retime


def driven(path: PiecewiseCubic, robot: RobotSpec, **more: Any) -> Track:
    trajectory = retime(path, limits_of(robot), with_turns(path, SpotTurning.of(robot), []))
    return follow(path, trajectory, robot, **more)


def test_without_noise_it_stays_on_its_path(kind: str, robot_of: Any, bends: Any) -> None:
    track = driven(bends, robot_of(kind, noise=False))
    assert track.finished
    assert track.tracking.cross.max < 0.03
    assert track.tracking.cross.p99 < 0.02
    assert np.hypot(*(track.positions[-1] - (20, 24))) < 0.03


def test_with_noise_and_delay_it_stays_within_fifteen_centimetres(
    kind: str, robot_of: Any, bends: Any
) -> None:
    for seed in range(5):
        track = driven(bends, robot_of(kind, lag_s=0.1), seed=seed)
        assert track.finished
        assert track.tracking.cross.p99 < 0.15
        assert track.tracking.along.p99 < 0.6


@pytest.mark.parametrize("left", [0.5, -0.8])
def test_a_robot_beside_its_path_comes_back_without_swinging_over(
    kind: str, robot_of: Any, left: float
) -> None:
    line = PiecewiseCubic([[[0, 0], [10, 0], [20, 0], [30, 0]]])
    track = driven(line, robot_of(kind, noise=False), offset=(0.0, left, 0.0))
    side = track.tracking.cross_track * math.copysign(1.0, left)
    assert side[0] == pytest.approx(abs(left))
    assert side.min() > -0.05 * abs(left) - 0.01
    assert abs(side[-1]) < 0.01


def test_a_robot_far_beside_its_path_comes_back_at_an_angle_without_stopping(robot_of: Any) -> None:
    """Its way back is steeper than the angle from which it turned on the spot: it stopped often."""
    line = PiecewiseCubic([[[0, 0], [10, 0], [20, 0], [30, 0]]])
    track = driven(line, robot_of("differential", noise=False), offset=(0.0, 3.0, 0.0))
    under_way = (track.positions[:, 0] > 0.5) & (track.positions[:, 0] < 25.0)
    assert track.speeds[under_way].min() > 0.2
    assert abs(track.tracking.cross_track[-1]) < 0.01


def test_a_robot_that_looks_the_other_way_turns_first(robot_of: Any) -> None:
    line = PiecewiseCubic([[[0, 0], [10, 0], [20, 0], [30, 0]]])
    track = driven(line, robot_of("differential", noise=False), offset=(0.0, 0.0, math.pi))
    assert track.finished
    assert np.abs(track.tracking.cross_track).max() < 0.15
    assert np.hypot(*(track.positions[-1] - (30, 0))) < 0.05


def test_a_corner_is_turned_on_the_spot(robot_of: Any) -> None:
    corner = CardinalSpline([(0, 0), (10, 0), (10, 10)], tension=1.0)
    track = driven(corner, robot_of("differential", noise=False))
    assert track.finished
    assert np.abs(track.tracking.cross_track).max() < 0.05
    at_rest = ~track.tracking.moving & (track.times > 1.0) & (track.times < track.times[-1] - 3.0)
    assert np.ptp(track.headings[at_rest]) == pytest.approx(math.pi / 2, abs=0.1)


@pytest.mark.parametrize("rounding", [1e-14, 1e-9])
def test_a_corner_that_lies_a_rounding_behind_its_rest_is_turned_all_the_same(
    robot_of: Any, rounding: float
) -> None:
    """It was waited for without turning: rest and corner are sums of the same lengths."""
    corner = CardinalSpline([(0, 0), (10, 0), (10, 10)], tension=1.0)
    robot = robot_of("differential", noise=False)
    law = retime(corner, limits_of(robot), with_turns(corner, SpotTurning.of(robot), []))
    before = np.where(np.abs(law.distances - 10.0) < 1e-6, law.distances - rounding, law.distances)
    track = follow(corner, replace(law, distances=before), robot)
    assert track.finished
    assert np.abs(track.tracking.cross_track).max() < 0.05
    assert np.abs(track.tracking.heading_error[track.tracking.moving]).max() < 0.1


def test_wheels_that_slip_on_the_spot_are_not_let_drift_off_it(robot_of: Any) -> None:
    """Left alone, as far as 0.29 m: speeds off by 0.1 m/s for half a second at a time."""
    robot = robot_of("differential", lag_s=0.1)
    drive = robot.drive.model_copy(update={"speed_noise_mps": 0.1})
    robot = robot.model_copy(update={"drive": drive})
    places = [(0, 0), (3, 0), (0.5, 1), (3, 2), (0, 2.5), (3, 3.5)]
    corners = CardinalSpline(places, tension=1.0)
    for seed in range(12):
        track = driven(corners, robot, seed=seed)
        assert track.finished
        assert np.abs(track.tracking.cross_track).max() < 0.2


@pytest.mark.parametrize("delay", [0.0, 0.1, 0.35, 1.0])
@pytest.mark.parametrize("lag", [0.0, 0.3])
def test_delay_and_lag_are_foreseen(
    kind: str, robot_of: Any, bends: Any, delay: float, lag: float
) -> None:
    track = driven(bends, robot_of(kind, noise=False, delay_s=delay, lag_s=lag))
    assert track.finished
    assert track.tracking.cross.max < 0.12


def test_a_robot_that_is_commanded_once_a_second_stays_about_its_path(
    kind: str, robot_of: Any, bends: Any
) -> None:
    """It corrected sooner than it measured, swung by metres, and most never came to the end."""
    track = driven(bends, robot_of(kind, noise=False), period=1.0)
    assert track.finished
    assert np.abs(track.tracking.cross_track).max() < 0.6


@pytest.mark.parametrize("gain", [0.5, 2.0])
def test_the_loop_has_a_gain_margin_of_two(robot_of: Any, bends: Any, gain: float) -> None:
    """Half and twice the feedback: a shorter or longer distance over which errors die out."""
    import viaspline.machine.trial_drive as module

    robot = robot_of("differential", lag_s=0.1)
    plain = module.drive_model_of
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(
            module, "drive_model_of",
            lambda *args: plain(*args)._replace(
                convergence_time=plain(*args).convergence_time / gain
            ),
        )  # fmt: skip
        track = driven(bends, robot)
    assert track.finished
    assert track.tracking.cross.max < 0.35


def test_a_time_law_that_is_too_fast_for_the_wheels_makes_it_late_not_lost(
    robot_of: Any, bends: Any
) -> None:
    robot = robot_of("differential", noise=False)
    assert robot.drive is not None
    slow = robot.drive.differential.model_copy(update={"max_wheel_speed_mps": 0.7})
    drive = robot.drive.model_copy(update={"differential": slow})
    trajectory = retime(bends, limits_of(robot))
    track = follow(bends, trajectory, robot.model_copy(update={"drive": drive}))
    assert track.finished
    assert track.times[-1] > trajectory.duration + 20.0
    assert track.tracking.cross.max < 0.05
    wheels = np.abs(track.speeds) + 0.25 * np.abs(track.yaw_rates)
    assert wheels.max() < 0.7 + 1e-6


def test_the_same_seed_gives_the_same_bytes(kind: str, robot_of: Any, bends: Any) -> None:
    one, same, other = (driven(bends, robot_of(kind), seed=seed) for seed in (4, 4, 5))
    assert one.positions.tobytes() == same.positions.tobytes()
    assert one.positions.tobytes() != other.positions.tobytes()


def test_turning_and_shifting_the_path_turns_and_shifts_the_drive(robot_of: Any) -> None:
    points = np.array([(0, 0), (15, 4), (25, -4), (40, 8)], float)
    turn = np.array([[0.6, -0.8], [0.8, 0.6]])
    robot = robot_of("differential", noise=False)
    plain = driven(CardinalSpline(points), robot)
    moved = driven(CardinalSpline(points @ turn.T + (30.0, -7.0)), robot)
    assert len(plain.times) == len(moved.times)
    assert moved.positions == pytest.approx(plain.positions @ turn.T + (30.0, -7.0), abs=1e-6)


@pytest.mark.parametrize("period", [0.0, -1.0, math.inf])
def test_a_period_is_above_zero(robot_of: Any, bends: Any, period: float) -> None:
    trajectory = retime(bends, limits_of(robot_of("point")))
    with pytest.raises(GeometryError, match="period is"):
        follow(bends, trajectory, robot_of("point"), period=period)


def test_a_route_with_heights_is_refused(robot_of: Any) -> None:
    line = PiecewiseCubic([[[0, 0, 0], [1, 0, 1], [2, 0, 2], [3, 0, 3]]])
    with pytest.raises(GeometryError, match="plane"):
        driven(line, robot_of("differential"))


def test_a_robot_that_is_behind_when_it_brakes_does_not_stop_short_and_wait_for_ever() -> None:
    """Its command was 0 where the feed-forward of braking met the feedback of being behind."""
    line = PiecewiseCubic([[[0, 0], [10 / 3, 0], [20 / 3, 0], [10, 0]]])
    late = RobotSpec(
        max_speed_mps=1.0,
        max_accel_mps2=1.0,
        drive={"differential": {"track_m": 0.26}, "lag_s": 0.41, "speed_noise_mps": 0.115},
    )
    for seed in range(3):
        track = driven(line, late, seed=seed)
        assert track.finished
        assert abs(10.0 - track.positions[-1, 0]) < 0.1
