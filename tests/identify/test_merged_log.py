import numpy as np
import pytest

import viaspline as vs
from viaspline.identify.fit_drive import fit_drive
from viaspline.identify.merged_log import merged_log
from viaspline.identify.simulated_log import simulated_log
from viaspline.identify.standard_drive import standard_commands
from viaspline.mission.robot_parts import RobotSpec

ROBOT = RobotSpec.model_validate({
    "radius_m": 0.3, "max_speed_mps": 1.2, "max_accel_mps2": 1.0,
    "drive": {"differential": {"track_m": 0.4}, "delay_s": 0.12, "lag_s": 0.15},
})  # fmt: skip


def test_a_drive_is_identified_when_its_poses_come_between_its_commands() -> None:
    commands = standard_commands(1.0, 0.8, 0.05)
    log = simulated_log(ROBOT, commands, 3)
    poses = np.column_stack((log.x, log.y, log.headings))
    times = np.arange(log.times[0] + 0.013, log.times[-1], 0.021)
    seen = np.column_stack([np.interp(times, log.times, column) for column in poses.T])
    told = np.column_stack((log.speeds, log.yaw_rates))
    found = fit_drive(merged_log(times, seen, log.times, told))
    assert found.delay.value == pytest.approx(0.12, abs=0.03)
    assert found.lag.value == pytest.approx(0.15, abs=0.03)


def test_before_the_first_command_the_robot_stands() -> None:
    times = np.arange(0.0, 12.0, 0.05)
    poses = np.zeros((len(times), 3))
    log = merged_log(times, poses, [6.0], [[0.7, 0.1]])
    assert log.speeds[log.times < 5.99].max() == 0.0
    assert log.speeds[log.times > 5.99].min() == 0.7


@pytest.mark.parametrize(("poses", "commands"), [(0, 5), (200, 0)])
def test_a_log_without_poses_or_commands_is_refused(poses: int, commands: int) -> None:
    times, told_at = 0.05 * np.arange(poses), 0.05 * np.arange(commands)
    with pytest.raises(vs.GeometryError, match="record odometry and cmd_vel"):
        merged_log(times, np.zeros((poses, 3)), told_at, np.zeros((commands, 2)))
