"""What a robot's clearance has to allow for: more than it gets beside its path in any drive."""

from __future__ import annotations

from typing import Any

import pytest

from viaspline.errors import GeometryError
from viaspline.machine.allowance import allowance, allowance_on_bends
from viaspline.machine.machine_limits import limits_of
from viaspline.machine.trial_drive import follow
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
