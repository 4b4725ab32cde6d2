"""Where a robot is taken to be: nearer to where it is than a measurement, and never astray."""

from __future__ import annotations

import math

import numpy as np
import pytest

from viaspline.kernels.tracking.drive_motion import HEADING, STATE
from viaspline.machine.pose_filter import PoseFilter
from viaspline.mission.robot_parts import RobotSpec

NOISY = RobotSpec(localization={"position_noise_m": 0.1, "heading_noise_deg": 3.0})


def pose(x: float, y: float, heading: float) -> np.ndarray:
    state = np.zeros(STATE)
    state[:3] = x, y, heading
    return state


def test_of_many_measurements_of_a_robot_that_stands_less_noise_is_left() -> None:
    random, fused = np.random.default_rng(1), PoseFilter.of(NOISY, 0.05)
    believed, off = pose(0, 0, 0), []
    for _ in range(4000):
        believed = fused.updated(believed, pose(*random.normal(0.0, 0.1, 2), 0.0))
        off.append(believed[:2])
    # of a filter with gain g the variance is g / (2 - g) of what comes in
    expected = 0.1 * math.sqrt(fused.gains[0] / (2.0 - fused.gains[0]))
    assert np.std(off[100:]) == pytest.approx(expected, rel=0.1)


def test_without_noise_what_is_measured_is_believed() -> None:
    exact = PoseFilter.of(RobotSpec(), 0.05)
    measured = pose(1.0, 2.0, 0.5)
    np.testing.assert_array_equal(exact.updated(pose(0, 0, 0), measured), measured)
    np.testing.assert_array_equal(exact.first(pose(0, 0, 0), measured), measured)


def test_headings_are_weighed_the_short_way_round() -> None:
    believed = PoseFilter.of(NOISY, 0.05).updated(pose(0, 0, 3.1), pose(0, 0, -3.1))
    assert 3.1 < believed[HEADING] < math.tau - 3.1


def test_at_first_it_is_at_the_start_unless_it_is_farther_off_than_noise() -> None:
    fused = PoseFilter.of(NOISY, 0.05)
    assert fused.first(pose(0, 0, 0), pose(0.2, -0.2, 0.1))[:3].tolist() == [0.0, 0.0, 0.0]
    put_down = fused.first(pose(0, 0, 0), pose(0.5, 0.0, math.pi))
    assert put_down[:3].tolist() == [0.5, 0.0, math.pi]
