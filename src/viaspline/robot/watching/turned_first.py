"""A robot without a drive that stands and looks another way than its path leads on: it turns first.

Its time law has no time for that where it isn't said how fast it turns, nor at its start. Where it
set off all the same, it would drive the way that it looks.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.machine.turns_on_spot import heading_onward
from viaspline.mission.spot_turning import told_rate_of
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.state import RobotState
from viaspline.robot.watching.true_place import is_there
from viaspline.robot.watching.watch import Watch
from viaspline.trajectory.trajectory import Trajectory

LEAVING_RAD = 0.05
"""By which it may look another way than its path leads when it sets off [rad]."""

SLOWER, LATER_S = 1.5, 2.0
"""So many times what a turn takes, and so much more, it is waited for [s]; then it sets off."""

NEAR_M = 0.2
"""Farther from its place of rest than this, beside what is kept, it has left it [m]."""

AT_REST_MPS = 1e-6
"""A robot of which its time law asks for less is to stand [m/s]."""

ROUNDING_S = 1e-9
"""Of the instant of a rest to which a time law was delayed."""

TURNING = "turning"


def turned_first(
    task: DriveTask,
    before: Watch,
    watch: Watch,
    schedule: Schedule,
    measured: RobotState,
    time: float,
) -> tuple[Watch, float]:
    """For how long the time law of a robot waits in this step, as it still has to turn [s].

    Args:
        task: What is asked of the drive.
        before: The watch of the step before.
        watch: With what was handed in now.
        schedule: What the robot means to do.
        measured: Where it is now.
        time: Now [s].

    Returns:
        The watch with until when it is waited for, and the wait.
    """
    law, robot = schedule.trajectory, task.mission.robot
    if task.model is not None or schedule.path.dimension > 2 or schedule.giving_up is not None:
        return watch, 0.0
    rest = _rest_left(law, before.time, time)
    if rest is None or is_there(schedule, measured, float(law.distance_at(time))):
        return watch.without_telling(TURNING), 0.0
    left_at, distance = rest
    gap = math.dist(schedule.path.at_distance(distance), measured.position)
    if gap > NEAR_M + task.requirements.tracking_error:
        return watch.without_telling(TURNING), 0.0
    way, rate = heading_onward(schedule.path, distance), told_rate_of(robot)
    angle = abs(math.remainder(way - measured.heading, math.tau))
    if angle <= LEAVING_RAD or rate == 0.0:
        return watch.without_telling(TURNING), 0.0
    until = watch.told.get(TURNING, time + SLOWER * angle / rate + LATER_S)
    if time > until:  # it doesn't turn as it is told
        return watch, 0.0
    return watch.having_told(TURNING, until), time - left_at


def _rest_left(law: Trajectory, since: float, time: float) -> tuple[float, float] | None:
    """The last rest that a time law has left since an earlier time: when [s], and where [m]."""
    if not math.isfinite(since):
        return None
    low, high = np.searchsorted(law.times, (since - ROUNDING_S, time))
    rests = np.flatnonzero(law.speeds[low:high] == 0.0)
    if not rests.size or low + rests[-1] + 1 == len(law.times):
        return None
    last = low + rests[-1]
    return float(law.times[last]), float(law.distances[last])
