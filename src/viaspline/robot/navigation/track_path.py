"""Where on its path a robot is, by what was measured, and the trajectory that waits for it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.tracking.control_law import CROSS_TRACK, PROGRESS, REST
from viaspline.kernels.tracking.drive_motion import ACROSS, ALONG, X, Y
from viaspline.robot.controller import Controller
from viaspline.robot.navigation.progress import SAME_PLACE_M, Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.state import RobotState

ON_PATH_M = 1e-6
"""Nearer than this the measured state is the planned one [m]."""

MAX_ALONG_TRACK_M = 0.05
"""Farther than this along the path from where it should be, a robot gets a new trajectory [m]."""

MAX_AHEAD_M = 0.005
"""So does one with a drive that is farther ahead than this [m]: else it would stop beyond the place
up to which it is certain to be free, and a little farther beyond with every stop. Where it is
behind, its trajectory waits."""

MAX_ROLL_M = 0.3
"""A robot with a drive that stands is looked for so far beyond its stop [m]."""

STANDSTILL_MPS = 0.02
"""A robot that is slower stands [m/s]."""


def track(
    progress: Progress, schedule: Schedule, measured: RobotState, time: float
) -> tuple[Progress, Schedule]:
    """How far the robot has come at a later time [s], and its schedule then.

    Progress is a distance along the path. It is looked for near the place where the trajectory has
    the robot, and never goes back, so a path that crosses or repeats itself makes no difference.
    """
    if progress.controller is not None:
        return _controlled(progress, progress.controller, schedule, measured, time)
    should = float(schedule.trajectory.state_at(time)[0])
    on_time = replace(progress, time=time, distance=max(should, progress.distance), along_track=0.0)
    place = np.asarray(schedule.path.at_distance(should))
    gap = float(np.linalg.norm(np.asarray(measured.position) - place))
    if gap <= ON_PATH_M:
        return replace(on_time, cross_track=0.0), schedule
    low = progress.distance
    high = min(should + max(1.0, 2.0 * gap), schedule.trajectory.next_rest(max(should, low)))
    distance, aside = project(schedule.path, measured.position, low, max(high, low))
    if abs(distance - should) <= MAX_ALONG_TRACK_M or schedule.giving_up is not None:
        return replace(on_time, cross_track=aside), schedule
    adrift = replace(on_time, distance=distance, cross_track=aside, along_track=distance - should)
    return adrift, schedule


def _controlled(
    progress: Progress,
    controller: Controller,
    schedule: Schedule,
    measured: RobotState,
    time: float,
) -> tuple[Progress, Schedule]:
    """The progress of a robot with a drive: its trajectory waits for it where it is too late.

    One that brakes for good isn't waited for: it stands when it has had the time for that.
    """
    controller = controller.on(schedule.path, schedule.trajectory).step(measured, time)
    if controller.late > 0.0 and schedule.giving_up is None:
        schedule = replace(schedule, trajectory=schedule.trajectory.delayed(controller.late))
    now = time + controller.ahead
    should = float(schedule.trajectory.distance_at(now))
    progress = replace(
        progress,
        time=now,
        distance=beyond_corner(schedule, max(should, progress.distance)),
        along_track=0.0,
        cross_track=abs(float(controller.note[CROSS_TRACK])),
        controller=controller,
    )
    ahead = _place_of(progress, controller, schedule) - progress.distance
    if ahead <= MAX_AHEAD_M or progress.dwell is not None or schedule.giving_up is not None:
        return progress, schedule
    return replace(progress, distance=progress.distance + ahead, along_track=ahead), schedule


def beyond_corner(schedule: Schedule, distance: float) -> float:
    """A distance along the path, beyond the corner if it is at one [m].

    Before it the controller would have the robot look the way that it came, and its trajectory,
    which looks ahead, would wait for it to turn.
    """
    for turn in schedule.turns:
        if abs(turn - distance) <= 2.0 * SAME_PLACE_M:
            return max(distance, turn + 0.5 * SAME_PLACE_M)
    return distance


def _place_of(progress: Progress, controller: Controller, schedule: Schedule) -> float:
    """Distance along the path of the place where a robot with a drive is [m].

    One that stands may have rolled on beyond the stop; at a corner it turns first.
    """
    if not controller.note[REST] > 0.0:
        return float(controller.note[PROGRESS])
    assert controller.believed is not None
    here, believed = progress.distance, controller.believed
    stops = [turn for turn in schedule.turns if turn >= here - SAME_PLACE_M]
    high = min([here + MAX_ROLL_M, schedule.path.length, *stops])
    if high <= here or math.hypot(believed[ALONG], believed[ACROSS]) > STANDSTILL_MPS:
        return here
    x, y = believed[[X, Y]].tolist()
    return project(schedule.path, (x, y), here, high)[0]


def with_command(
    before: Controller | None,
    progress: Progress,
    schedule: Schedule,
    measured: RobotState,
    time: float,
    work: float = 0.0,
) -> tuple[Progress, Schedule]:
    """The robot when its controller has given its command, by the schedule that there is now.

    A command that is given later is one for later: held on for the time of a search, what the
    robot was told in a bend leads it off its path, and the next one has to be right for then.

    Args:
        before: The controller before this step.
        progress: With the controller after it has decided by the schedule before this step.
        schedule: What the robot means to do now: if that is new, the controller decides again.
        measured: Where the robot is.
        time: When that was measured [s].
        work: How much later the command is given [s].
    """
    controller = progress.controller
    if controller is None or before is None:
        return progress, schedule
    is_new = (
        schedule.path is not controller.path or schedule.trajectory is not controller.trajectory
    )
    if is_new or work > 0.0:
        waited = controller.late > 0.0
        controller = before.on(schedule.path, schedule.trajectory).step(measured, time, work)
        if controller.late > 0.0 and not waited and schedule.giving_up is None:
            schedule = replace(schedule, trajectory=schedule.trajectory.delayed(controller.late))
    if schedule.stays_put:
        controller = controller.staying_put()
    return replace(progress, controller=controller.gave(time + work)), schedule


def project(
    path: Path, position: tuple[float, ...], low: float, high: float
) -> tuple[float, float]:
    """The nearest place of a path between two distances, and how far it is away [m].

    Example:
        >>> path = Path([[[0, 0], [3, 0], [6, 0], [9, 0]]], vias=[])
        >>> [round(value, 6) for value in project(path, (4.0, 0.5), 0.0, 9.0)]
        [4.0, 0.5]
    """
    point = np.asarray(position)
    while True:
        places = np.linspace(low, high, 33)
        gaps = np.linalg.norm(np.asarray(path.at_distance(places)) - point, axis=1)
        k = int(gaps.argmin())
        if high - low <= SAME_PLACE_M:
            return float(places[k]), float(gaps[k])
        low, high = float(places[max(k - 1, 0)]), float(places[min(k + 1, 32)])
