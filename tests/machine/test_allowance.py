"""What a robot's clearance has to allow for: more than it gets beside its path in any drive."""

from __future__ import annotations

from typing import Any

import pytest

from viaspline.errors import GeometryError
from viaspline.machine.allowance import allowance, allowance_on_bends
from viaspline.machine.machine_limits import limits_of
from viaspline.machine.trial_drive import follow
from viaspline.mission.model import Mission
from viaspline.planner import plan
from viaspline.trajectory.retime import retime


def test_other_seeds_stay_within_the_allowance(robot_of: Any, bends: Any, kind: str) -> None:
    robot = robot_of(kind)
    trajectory = retime(bends, limits_of(robot))
    allowed = allowance(bends, trajectory, robot)
    for seed in range(4):
        tracking = follow(bends, trajectory, robot, seed=seed).tracking
        assert tracking.body_deviation(0.0) <= allowed


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
        "ackermann": {"wheelbase_m": 1.152, "max_steer_deg": 45, "max_steer_rate_degps": 15},
        "delay_s": 0.05, "lag_s": 0.1, "yaw_rate_noise_degps": 2,
    }  # fmt: skip
    document: dict[str, Any] = {
        "robot": {"radius_m": 0, "clearance_m": 0.144, "drive": drive, "sensor": {"range_m": 12}},
        "route": {"start": [0, 0], "via": [[54, 0], [54, 21]], "goal": [0, 21]},
    }
    with pytest.raises(GeometryError, match=r"bends of 1\.38 m, which a path.*under way") as told:
        plan(Mission.model_validate(document))
    assert "faster steering (max_steer_rate_degps), or say what to keep" in str(told.value)
    drive["ackermann"]["max_steer_rate_degps"] = 30  # type: ignore[index]
    assert plan(Mission.model_validate(document)).certificate.holds
    drive["ackermann"]["max_steer_rate_degps"] = 15  # type: ignore[index]
    document["robot"]["tracking_error_m"] = 0.4
    assert plan(Mission.model_validate(document)).certificate.holds
