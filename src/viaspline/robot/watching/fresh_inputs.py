"""Whether what a robot is handed is of now: its pose, its scans, and its clock.

A robot that drives by what was true a while ago drives blind. So what is older than ``STALE_S``
stops it; it goes on when something newer comes. A stamp as far ahead of the clock is of another
clock, and tells no age: a sensor that hangs would count as fresh until then.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from viaspline.kernels.tracking import control_law
from viaspline.kernels.tracking.drive_motion import ACROSS, ALONG, HEADING, X, Y, predict
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.progress import Progress
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.perception.moving.motion_sensor import MovingSighting
from viaspline.robot.run import Event
from viaspline.robot.state import RobotState
from viaspline.robot.watching.watch import Watch

STALE_S = 0.2
"""What is older stops the robot [s]; or than two of its longest steps, if that is more."""

MOVING_MPS = 0.05
"""A robot that says it is faster, and is where it was, tells of what is over [m/s]."""

ROUNDING_S = 1e-9
"""Part of a time by which it may be missed."""

Sensed = Iterable[Obstacle | MovingSighting] | Scan


@dataclass(frozen=True)
class FreshInputs:
    """What a robot is to go by in a step.

    Attributes:
        measured: Where it is now: as measured, carried on to now, or as far as its model knows.
        sensed: What is seen now; nothing if a scan shows nothing.
        watch: With what was handed in.
        events: What was told of it.
        stale: Why the robot is to be held still; None if it isn't.
    """

    measured: RobotState
    sensed: Sensed
    watch: Watch
    events: tuple[Event, ...]
    stale: str | None


def fresh_inputs(
    task: DriveTask,
    watch: Watch,
    progress: Progress,
    schedule: Schedule,
    state: RobotState,
    sensed: Sensed,
    time: float,
) -> FreshInputs:
    """What a robot is to go by, and whether that is of now.

    Args:
        task: What is asked of the drive.
        watch: Of the step before.
        progress: As of the step before.
        schedule: What the robot means to do.
        state: As it was handed in.
        sensed: As it was handed in.
        time: Now [s].
    """
    limit = max(STALE_S, 2.0 * task.reaction)
    seen = _seen(task, watch, sensed, time, limit)
    seen = _heard(seen, state, time, limit)
    ages = {"pose": time - seen.at, "scan": _scan_age(task, seen, time)}
    late = time - watch.time
    follows_exactly = task.model is None and not _has_lidar(task)
    if not follows_exactly and math.isfinite(late):
        is_blind = late > limit and _meant_to_move(schedule, watch.time, time)
        ages["step"] = late if is_blind else min(late, limit)
    place, events = schedule.place(progress.distance), []
    slip = ROUNDING_S * (1.0 + abs(time))
    for what, age in ages.items():
        if abs(age) <= limit + slip:
            seen = seen.without_telling(what)
        elif what not in seen.told:
            seen = seen.having_told(what, age)
            words = (WORDS[what] if age > 0.0 else AHEAD).format(abs(age), limit, what)
            data = {"what": what, "age_s": age, "allowed_s": limit}
            events.append(Event("stale", time, place, words, data))
    why = next((what for what in ("pose", "scan") if abs(ages[what]) > limit + slip), None)
    here = state
    if why == "pose":
        here = as_modelled(task, progress, schedule, state, time)
    elif ages["pose"] > slip and state.stamp is not None:
        here = carried_on(state, ages["pose"])
    nothing = isinstance(sensed, Scan) and sensed.shows_nothing
    return FreshInputs(
        here, () if nothing else sensed, replace(seen, time=time), tuple(events), why
    )


WORDS = {
    "pose": "stops: what it is told of its pose is {:.2f} s old, {:.2f} s are allowed",
    "scan": "stops: the last scan is {:.2f} s old, {:.2f} s are allowed",
    "step": "has driven blind: the step before was {:.2f} s ago, {:.2f} s are allowed",
}

AHEAD = "stops: the stamp of its {2} is {0:.2f} s ahead of its clock, {1:.2f} s are allowed"


def _meant_to_move(schedule: Schedule, since: float, time: float) -> bool:
    """Whether a robot was to drive between two times [s]: one that stands is never blind."""
    before, now = schedule.trajectory.distance_at(np.array([since, time])).tolist()
    return bool(before != now)


def _has_lidar(task: DriveTask) -> bool:
    sensor = task.mission.robot.sensor
    return sensor is not None and sensor.lidar is not None


def _taken(stamp: float, time: float, limit: float) -> float:
    """When something was taken by its stamp [s]: now, if that is no more than a limit ahead."""
    return stamp if stamp > time + limit else min(stamp, time)


def _seen(task: DriveTask, watch: Watch, sensed: Sensed, time: float, limit: float) -> Watch:
    """With the time of a scan; the first is waited for from the first step on."""
    if not _has_lidar(task):
        return watch
    if isinstance(sensed, Scan) and not sensed.shows_nothing:
        taken = time if sensed.stamp is None else _taken(sensed.stamp, time, limit)
        last = watch.scanned_at if watch.scanned_at <= time else taken
        return replace(watch, scanned_at=max(taken, last))
    return replace(watch, scanned_at=time) if math.isinf(watch.scanned_at) else watch


def _scan_age(task: DriveTask, watch: Watch, time: float) -> float:
    return time - watch.scanned_at if _has_lidar(task) else 0.0


def _heard(watch: Watch, state: RobotState, time: float, limit: float) -> Watch:
    """With what was measured, and when: a pose that stands still while it says that it moves."""
    before = watch.measured
    frozen = before is not None and state.ground_speed > MOVING_MPS and _is_as(state, before)
    moved_at = watch.moved_at if frozen else time
    at = moved_at if state.stamp is None else _taken(state.stamp, time, limit)
    return replace(watch, measured=state, at=at, moved_at=moved_at)


def _is_as(state: RobotState, before: RobotState) -> bool:
    """Whether the same was measured again."""
    now, then = ((one.position, one.speed, one.speed_across) for one in (state, before))
    return now == then


def carried_on(state: RobotState, seconds: float) -> RobotState:
    """A state some time later [s], straight on.

    >>> carried_on(RobotState((1.0, 0.0), 0.0, speed=2.0), 0.1).position
    (1.2, 0.0)
    """
    x, y = state.position[:2]
    c, s = math.cos(state.heading), math.sin(state.heading)
    ahead, left = seconds * state.speed, seconds * state.speed_across
    place = (x + c * ahead - s * left, y + s * ahead + c * left, *state.position[2:])
    return replace(state, position=place)


def as_modelled(
    task: DriveTask, progress: Progress, schedule: Schedule, state: RobotState, time: float
) -> RobotState:
    """Where a robot is by what it was told, if nothing was measured that still holds.

    Args:
        task: What is asked of the drive.
        progress: As of the step before.
        schedule: What it means to do.
        state: The last that was measured.
        time: Now [s].
    """
    controller = progress.controller
    if controller is None or controller.believed is None or task.model is None:
        distance, speed, _ = (float(x) for x in schedule.trajectory.state_at(time))
        u = float(schedule.path.parameter(distance))
        heading = float(schedule.path.heading(u))
        return replace(state, position=schedule.place(distance), heading=heading, speed=speed)
    last = float(controller.memory[control_law.LAST_TIME])
    pose = predict(task.model, controller.believed, last, max(time, last), controller.given.copy())
    x, y, heading, along, across = pose[[X, Y, HEADING, ALONG, ACROSS]].tolist()
    return RobotState((x, y), heading, along, across)
