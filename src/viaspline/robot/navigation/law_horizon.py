"""How far ahead a time law reaches, and when the next one is found.

A limit of the jerk, and limits that couple speed and acceleration, make a law dear: what it costs
grows with its length. A robot that drives finds it for a part of its path, which goes along with
it, and keeps it as long as it will do.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.curve.path import Path
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.progress import SAME_PLACE_M, Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.perception.belief import MIN_DISC_RADIUS_M
from viaspline.trajectory.coupled import is_coupled
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.part import end_of_cells
from viaspline.trajectory.trajectory import Trajectory

PART_RATIO, PART_S = 2.0, 3.0
"""Where laws are dear a new one reaches so many stopping distances ahead, and what the robot
drives in so long a time [s],"""

LEAST_PART_M = 0.8 * MIN_DISC_RADIUS_M
"""but no less than this, which is less than the smallest cell that a robot probes: one that stands
stays there, and one that stops there does [m];"""

MOST_CELLS = 250
"""With a limit of the jerk a new one has no more cells than this, each of which takes a tenth of a
millisecond and more: where a path bends sharply they are tenths of a millimetre long,"""

STOP_ROOM = 2.0
"""unless it has more of them on so many times the way on which the robot stops at the latest;"""

RENEWAL_S = 0.5
"""and is found anew so much before it has to brake for its end [s]."""

BRAKING_SPARE = 1.05
"""To brake takes a law so much longer than by its limit: cells and rounding keep it from that."""

DRIVEN_RATIO = 0.5
"""On a round where laws are cheap one is found anew when so much of it is driven."""


def is_in_parts(limits: Limits, path: Path) -> bool:
    """Whether time laws under way are found for a part of the path: under limits that cost much.

    Args:
        limits: Of the time law.
        path: What is driven.
    """
    return limits.max_jerk is not None or is_coupled(limits, path.dimension)


def reach_ahead(task: DriveTask, schedule: Schedule) -> float:
    """How far ahead of the robot a new time law reaches at most [m].

    Args:
        task: What is asked of the drive.
        schedule: What the robot means to do.
    """
    if is_in_parts(task.limits, schedule.path):
        return PART_RATIO * _stopping_distance(task) + PART_S * task.limits.max_speed
    return reach_of_all(schedule)


def dense_until(
    task: DriveTask, path: Path, distance: float, end: float, motion: tuple[float, float]
) -> float:
    """Where a new time law ends that would have too many cells on its way to its end [m].

    Args:
        task: What is asked of the drive.
        path: What is driven.
        distance: Where the law begins [m].
        end: Where it ends at the latest [m].
        motion: Speed and acceleration where it begins [m/s], [m/s²].
    """
    limits, (speed, accel) = task.limits, motion
    if limits.max_jerk is None:
        return end
    time = speed / limits.brake + (limits.brake + abs(accel)) / limits.max_jerk
    short = distance + max(STOP_ROOM * speed * time, LEAST_PART_M)
    if short >= end:
        return end
    return max(end_of_cells(path, distance, end, limits, speed, MOST_CELLS), short)


def reach_of_all(schedule: Schedule) -> float:
    """How far ahead a time law reaches that is for all of the path, or all of a round [m].

    Args:
        schedule: What the robot means to do.
    """
    laps = schedule.laps
    return laps.timed if laps is not None and schedule.is_round else math.inf


def renewed_at(task: DriveTask, knowledge: Knowledge, schedule: Schedule) -> float:
    """When a time law is to be found anew though nothing was seen, because it ends too soon [s].

    One for a part of the path has to reach farther while the robot drives; else inf, and with a
    lidar, which sees to that itself.

    Args:
        task: What is asked of the drive.
        knowledge: All that is known.
        schedule: What the robot means to do.
    """
    law, in_parts = schedule.trajectory, is_in_parts(task.limits, schedule.path)
    first, end = law.distances[[0, -1]].tolist()
    is_whole = end >= min(schedule.path.length, schedule.held_at) - SAME_PLACE_M
    is_part = (in_parts or schedule.is_round) and not is_whole
    if not is_part or knowledge.belief is not None or schedule.giving_up is not None:
        return math.inf
    if not in_parts:
        return float(law.time_at(DRIVEN_RATIO * first + (1.0 - DRIVEN_RATIO) * end))
    return _brakes_at(law, task.limits) - RENEWAL_S


def _brakes_at(law: Trajectory, limits: Limits) -> float:
    """When a robot has to brake at the soonest for the end of its time law [s]."""
    times, jerk = BRAKING_SPARE * law.speeds / limits.brake, limits.max_jerk
    if jerk is not None:  # one that is slow never brakes as hard as it can
        soft = law.speeds < limits.brake**2 / jerk
        times = np.where(soft, 2.0 * np.sqrt(law.speeds / jerk), times + limits.brake / jerk)
    return float(law.times[int(np.argmax(law.times + times >= law.end_time))])


def is_due(task: DriveTask, progress: Progress, knowledge: Knowledge, schedule: Schedule) -> bool:
    """Whether the time law of a robot with a lidar is to be found anew after one more look.

    Where laws are cheap it always is. Where they are dear, what there is will do for a while: as
    long as it is certain to be free, and the robot is under way on it.

    Args:
        task: What is asked of the drive.
        progress: How far the robot has come.
        knowledge: All that is known, by a lidar.
        schedule: What it means to do.
    """
    law, now = schedule.trajectory, progress.time
    moves = bool(law.state_at(now)[1] > 0.0) and now < law.end_time
    if not is_in_parts(task.limits, schedule.path) or not moves:
        return True
    stops = float(law.distances[-1]) - progress.distance < LEAST_PART_M
    if now >= schedule.timed_at + RENEWAL_S and not stops:
        return True
    required, end = task.requirements.required, float(law.distances[-1])
    assert knowledge.belief is not None
    for start, until, floor in schedule.kept(progress.distance, end, required):
        if knowledge.belief.clear_until(schedule.path, start, until, floor) < until:
            return True
    return False


def _stopping_distance(task: DriveTask) -> float:
    """In which the robot stops from full speed, straight ahead [m]."""
    top, brake, jerk = task.limits.max_speed, task.limits.brake, task.limits.max_jerk
    return 0.5 * top * (top / brake + (0.0 if jerk is None else brake / jerk))
