"""What a robot's clearance has to allow for: more than it gets beside its path in any drive."""

from __future__ import annotations

import math
from contextlib import suppress
from typing import Any

import numpy as np
import pytest

from viaspline.curve.cardinal import CardinalSpline
from viaspline.errors import GeometryError
from viaspline.machine.allowance import TrialDrives, allowance, allowance_on_bends
from viaspline.machine.machine_limits import limits_of
from viaspline.machine.trial_drive import follow, trackings
from viaspline.mission.model import Mission
from viaspline.mission.robot_parts import RobotSpec
from viaspline.planner import plan
from viaspline.trajectory.limits import Station
from viaspline.trajectory.retime import retime


def test_other_seeds_stay_within_the_allowance(robot_of: Any, bends: Any, kind: str) -> None:
    robot = robot_of(kind)
    trajectory = retime(bends, limits_of(robot))
    allowed = allowance(bends, trajectory, robot)
    for seed in range(4):
        tracking = follow(bends, trajectory, robot, seed=seed).tracking
        assert tracking.body_deviation(0.0) <= allowed


def test_trial_drives_are_driven_once_whatever_is_asked_of_them(
    robot_of: Any, bends: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    driven = []

    def counted(*asked: Any) -> Any:
        driven.append(asked)
        return trackings(*asked)

    monkeypatch.setattr("viaspline.machine.allowance.trackings", counted)
    robot = robot_of("differential")
    law = retime(bends, limits_of(robot))
    trials = TrialDrives(bends, law, robot)
    assert not driven
    assert trials.largest_deviation < trials.allowance
    assert len(driven) == 1


def test_a_stay_of_months_costs_no_more_than_one_of_minutes(robot_of: Any, bends: Any) -> None:
    robot = robot_of("differential")
    half = 0.5 * bends.length
    months, minutes = (
        allowance(bends, retime(bends, limits_of(robot), [Station(half, stay)]), robot)
        for stay in (1e7, 600.0)
    )
    assert months == pytest.approx(minutes, abs=1e-6)


def test_a_robot_that_would_crawl_for_weeks_is_refused_at_once(robot_of: Any, bends: Any) -> None:
    robot = robot_of("differential").model_copy(update={"max_yaw_rate_degps": 1e-4})
    with pytest.raises(GeometryError, match="raise the limits"):
        allowance(bends, retime(bends, limits_of(robot)), robot)


@pytest.mark.parametrize("kind", ["differential", "skid-steer", "ackermann"])
def test_what_a_drive_seldom_does_is_kept_as_well(robot_of: Any, kind: str) -> None:
    """Few drives of a short path run past its end by much; of three trial drives none did."""
    path = CardinalSpline([(0, 0), (2, 0.5), (4, 0)], knots="chordal", tangents="continuous")
    plain = robot_of(kind, lag_s=0.1, max_speed_mps=1.5)
    drive = plain.drive.model_copy(update={"speed_noise_mps": 0.08})
    robot = plain.model_copy(update={"drive": drive})
    law = retime(path, limits_of(robot))
    kept = allowance(path, law, robot)
    drives = (follow(path, law, robot, seed=seed).tracking for seed in range(100))
    assert sum(tracking.body_deviation(0.0) > kept for tracking in drives) <= 1


def steered(rate: float, wheelbase: float, speed: float, noise: float) -> RobotSpec:
    """A robot whose wheels turn so fast [deg/s], with noise of its yaw rate [deg/s]."""
    drive = {
        "ackermann": {
            "wheelbase_m": wheelbase, "max_steer_deg": 32, "max_steer_rate_degps": rate,
        },
        "delay_s": 0.1, "lag_s": 0.1, "yaw_rate_noise_degps": noise,
    }  # fmt: skip
    return RobotSpec.model_validate(
        {
            "max_speed_mps": speed,
            "max_lateral_accel_mps2": 0.8,
            "drive": drive,
            "localization": PLACE,
        }
    )


PLACE = {"position_noise_m": 0.02, "heading_noise_deg": 1.0}


@pytest.mark.parametrize("seed", range(12))
def test_however_slow_its_steering_a_robot_stays_within_what_is_kept_or_is_refused(
    seed: int,
) -> None:
    """A distance over which deviations die out that is too short for it: 10 m off, 0.3 m kept."""
    random = np.random.default_rng(seed)
    rate = float(np.exp(random.uniform(np.log(0.5), np.log(60.0))))
    robot = steered(rate, *random.uniform((0.5, 0.5, 0.0), (2.0, 2.5, 5.0)).tolist())
    steps = np.column_stack((random.uniform(4, 9, 5), random.uniform(-4, 4, 5)))
    path = CardinalSpline(np.cumsum(steps, axis=0), knots="chordal", tangents="continuous")
    law = retime(path, limits_of(robot))
    kept = math.inf
    with suppress(GeometryError):  # it is refused, as is tested below
        kept = allowance(path, law, robot)
    for other in range(2):
        assert follow(path, law, robot, seed=other).tracking.body_deviation(0.0) <= kept


@pytest.mark.parametrize("rate", [10.0, 15.0, 20.0])
def test_slow_steering_keeps_to_its_path_where_it_once_swung_metres_off(
    bends: Any, rate: float
) -> None:
    robot = steered(rate, wheelbase=1.7, speed=2.0, noise=2.0)
    assert allowance(bends, retime(bends, limits_of(robot)), robot) < 1.5


def test_more_noise_asks_for_more(robot_of: Any) -> None:
    quiet = allowance_on_bends(robot_of("differential", noise=False), 2.0)
    assert quiet < allowance_on_bends(robot_of("differential"), 2.0)


def test_a_robot_that_can_not_follow_is_told_what_to_change(robot_of: Any, bends: Any) -> None:
    robot = robot_of("differential", noise=False)
    crawling = {"differential": {"track_m": 0.5, "max_wheel_speed_mps": 0.02}}
    slow = type(robot).model_validate({"drive": crawling})
    with pytest.raises(GeometryError, match="give it a lower max_speed_mps"):
        allowance(bends, retime(bends, limits_of(robot)), slow)


def test_bends_that_nobody_knows_yet_are_named_with_what_lets_them_be_followed() -> None:
    """The path may be followed well; it is the next one, laid under way, that may not be."""
    drive = {
        "ackermann": {"wheelbase_m": 1.152, "max_steer_deg": 45, "max_steer_rate_degps": 0.2},
        "delay_s": 0.05, "lag_s": 0.1, "yaw_rate_noise_degps": 6,
    }  # fmt: skip
    document: dict[str, Any] = {
        "robot": {"radius_m": 0, "clearance_m": 0.144, "drive": drive, "sensor": {"range_m": 12}},
        "route": {"start": [0, 0], "goal": [12, 0]},
    }
    with pytest.raises(GeometryError, match=r"bends of 1\.38 m, which a path.*under way") as told:
        plan(Mission.model_validate(document))
    assert "faster steering (max_steer_rate_degps), or say what to keep" in str(told.value)
    drive["ackermann"]["max_steer_rate_degps"] = 15  # type: ignore[index]
    assert plan(Mission.model_validate(document)).certificate.holds
    drive["ackermann"]["max_steer_rate_degps"] = 0.2  # type: ignore[index]
    document["robot"]["tracking_error_m"] = 0.4
    assert plan(Mission.model_validate(document)).certificate.holds
