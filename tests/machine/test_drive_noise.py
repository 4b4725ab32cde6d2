"""Noise that depends on its seed and on how much was drawn, and on nothing else."""

from __future__ import annotations

import numpy as np
import pytest

from viaspline.machine.drive_noise import DriveNoise
from viaspline.mission.robot_parts import RobotSpec

ROBOT = RobotSpec(localization={"position_noise_m": 0.1, "heading_noise_deg": 2.0})


def test_drawing_in_parts_is_drawing_at_once() -> None:
    whole, parts = DriveNoise(ROBOT, 3), DriveNoise(ROBOT, 3)
    both = np.vstack((parts.measured(4), parts.measured(6)))
    assert np.array_equal(whole.measured(10), both)
    parts.measured(5)  # how often it looked doesn't change how it drives
    assert np.array_equal(whole.driven(8), parts.driven(8))


def test_no_error_of_a_measurement_is_beyond_three_deviations() -> None:
    errors = DriveNoise(ROBOT, 5).measured(20_000)
    widest = np.array([0.3, 0.3, np.radians(6.0)])
    assert (np.abs(errors) <= widest + 1e-12).all()
    assert errors.std(axis=0) == pytest.approx([0.1, 0.1, np.radians(2.0)], rel=0.05)


def test_a_robot_that_knows_where_it_is_measures_no_error() -> None:
    assert not DriveNoise(RobotSpec(), 1).measured(9).any()
