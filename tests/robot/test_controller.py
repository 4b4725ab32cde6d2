"""What a controller keeps of its commands: the one that acts stays until the next one does."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.path import Path
from viaspline.kernels.tracking.control_law import CROSS_TRACK, TIME
from viaspline.kernels.tracking.drive_motion import ALONG, GIVEN_AT, HEADING, X, Y, move
from viaspline.machine.machine_limits import limits_of
from viaspline.machine.pose_filter import PoseFilter
from viaspline.machine.robot_model import drive_model_of
from viaspline.machine.settling import STILL_MPS, settled_after_law
from viaspline.machine.trial_drive import start_of
from viaspline.mission.model import Mission
from viaspline.mission.robot_parts import RobotSpec
from viaspline.robot.controller import Controller
from viaspline.robot.navigator import Navigator
from viaspline.robot.state import RobotState
from viaspline.trajectory.retime import retime

Make = Callable[..., Mission]

PERIOD_S, SEARCH_S = 0.05, 0.045
LATE = {"delay_s": 0.1, "lag_s": 0.1}
DRIVES = [
    {"differential": {"track_m": 0.4}, **LATE},
    {"ackermann": {"wheelbase_m": 0.4, "max_steer_deg": 40}, **LATE},
]


def test_the_command_that_acts_is_kept_however_late_the_next_one_is(mission_of: Make) -> None:
    """After a search of two periods it had been dropped, and the simulated drive stopped."""
    nav = Navigator(mission_of([0, 0], [20, 0], drive={"differential": {"track_m": 0.4}}))
    _, nav = nav.step(nav.reference(0.0), [], 0.0)
    assert nav.controller is not None
    for late in (0.01, 0.1, 0.4, 2.0):
        given = nav.controller.gave(0.05 + late).given[:, GIVEN_AT]
        np.testing.assert_allclose(given[-2:], [0.0, 0.05 + late])


@pytest.mark.parametrize("drive", DRIVES)
def test_a_command_that_is_given_later_is_one_for_later(drive: dict[str, object]) -> None:
    """Searching for six looks now and then leaves a robot on a slalom nearly as near to it."""
    told = _farthest_beside(drive, search=SEARCH_S, told=SEARCH_S)
    assert told < 2.0 * _farthest_beside(drive, search=0.0, told=0.0)
    assert told < 0.5 * _farthest_beside(drive, search=SEARCH_S, told=0.0)


def _farthest_beside(drive: dict[str, object], search: float, told: float) -> float:
    """How far a robot gets beside a slalom when now and then six commands in a row are late [m]."""
    robot = RobotSpec.model_validate({"max_speed_mps": 1.5, "max_accel_mps2": 1.0, "drive": drive})
    slalom = CardinalSpline(
        [[3.0 * k, (-1.0) ** k * 0.9] for k in range(6)], knots="chordal", tangents="continuous"
    )
    path, model = Path(slalom.spans, vias=[]), drive_model_of(robot, PERIOD_S)
    law = retime(path, limits_of(robot))
    controller = Controller.of(model, PERIOD_S, path, law, PoseFilter.of(robot, PERIOD_S))
    state, beside, tick = start_of(model, controller.reference), 0.0, 0
    while tick * PERIOD_S < law.end_time:
        time, late = tick * PERIOD_S, float(tick // 6 % 2)
        at = RobotState((state[X], state[Y]), float(state[HEADING]), float(state[ALONG]))
        controller = controller.step(at, time, late * told)
        assert controller.note[TIME] == pytest.approx(time + late * told + model.delay)
        beside = max(beside, abs(float(controller.note[CROSS_TRACK])))
        controller = controller.gave(time + late * search)
        move(model, state, time, PERIOD_S / 10, controller.given.copy(), np.zeros((10, 2)))
        tick += 1
    return beside


@pytest.mark.parametrize("noise", [0.0, 0.02])
def test_one_that_stays_put_stands_though_its_law_has_just_come_to_rest(noise: float) -> None:
    """It rolled on for half a second, and by the noise of what it measures to and fro for ever."""
    robot = RobotSpec.model_validate({"drive": DRIVES[0], "max_brake_mps2": 1.5})
    path, model = Path([[(0, 0), (1, 0), (2, 0), (3, 0)]], []), drive_model_of(robot, PERIOD_S)
    law, random = retime(path, limits_of(robot)), np.random.default_rng(3)
    controller = Controller.of(model, PERIOD_S, path, law, PoseFilter.of(robot, PERIOD_S))
    state, tick, speeds = start_of(model, controller.reference), 0, []
    while tick * PERIOD_S < law.end_time + 2.0:
        time, off = tick * PERIOD_S, random.normal(0.0, noise, 3)
        at = RobotState((state[X] + off[0], state[Y] + off[1]), state[HEADING] + off[2],
                        float(state[ALONG]))  # fmt: skip
        controller = controller.step(at, time).staying_put().gave(time)
        move(model, state, time, PERIOD_S / 10, controller.given.copy(), np.zeros((10, 2)))
        tick += 1
        if time > law.end_time + settled_after_law(model, 1.5, PERIOD_S):
            speeds.append(abs(float(state[ALONG])))
    assert max(speeds) < STILL_MPS
