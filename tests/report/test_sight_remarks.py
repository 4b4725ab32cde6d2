"""What ``viaspline check`` says of a robot that passive safety holds back, beside its drives."""

from typing import Any

import pytest

import viaspline as vs
from viaspline.report.remarks import remarks


def mission(goal: float = 3.0, **robot: Any) -> vs.Mission:
    body = {"radius_m": 0.25, "clearance_m": 0.1, "max_speed_mps": 1, "max_accel_mps2": 1}
    return vs.Mission.model_validate(
        {"robot": {**body, **robot}, "route": {"start": [0, 0], "goal": [goal, 0]}}
    )


def test_one_that_sees_little_drives_no_faster_than_is_said() -> None:
    asked = mission(goal=0.5, moving={"max_speed_mps": 1.5}, sensor={"range_m": 0.5})
    [found] = remarks(asked)
    assert "0.158 m/s at most" in found
    assert "sensor.range_m 2.5 would allow it" in found
    assert 0.05 < vs.simulate(asked, step=0.1).speeds.max() <= 0.158


def test_one_that_sees_as_far_as_was_advised_drives_as_fast_as_it_may() -> None:
    asked = mission(moving={"max_speed_mps": 1.5}, sensor={"range_m": 2.5})
    assert remarks(asked) == []
    assert vs.simulate(asked, step=0.1).speeds.max() == pytest.approx(1.0)


def test_of_a_lidar_its_own_key_is_named() -> None:
    [found] = remarks(mission(moving={}, sensor={"lidar": {"range_m": 1}}))
    assert "sensor.lidar.range_m" in found


def test_one_without_a_sensor_is_told_that_it_never_sets_off() -> None:
    asked = mission(moving={})
    [found] = remarks(asked)
    assert "never sets off" in found
    run = vs.simulate(asked, step=2.0)
    assert not run.reached
    assert run.speeds.max() == 0.0
    assert run.reason is not None
    assert "robot.sensor" in run.reason


@pytest.mark.parametrize("things", [None, {"safety": "none"}])
def test_nothing_is_said_where_nothing_is_promised(things: Any) -> None:
    assert remarks(mission(moving=things, sensor={"range_m": 0.5})) == []
