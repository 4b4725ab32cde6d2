"""How far beside its path a robot is, and whether that is more than is kept for it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.knowledge import Knowledge
from viaspline.robot.navigation.schedule import Schedule
from viaspline.robot.state import RobotState
from viaspline.robot.watching.looks_away import looks_away_by, ways_to_path
from viaspline.robot.watching.measured_motion import noise_of
from viaspline.robot.watching.set_beside import (
    SETTLED,
    dies_out_over,
    floor_back,
    is_way_back_clear,
    room_on,
    way_back,
)
from viaspline.robot.watching.true_place import TruePlace
from viaspline.robot.watching.turned_first import AT_REST_MPS
from viaspline.robot.watching.watch import Excuse, Watch
from viaspline.trajectory.slow_zones import Slow

BESIDE_M = 0.005
"""What is farther beside the path than is kept, by less, is not told of [m]."""

MARGIN = 1.5
"""By which what is kept from then on is more than what was measured, as that of trial drives is,"""

LEAST_GROWTH_M = 0.02
"""and at least more than before [m]: so that it isn't told again at every step."""

DIED_OUT_M = 0.005
"""A deviation that is less is over [m]."""


@dataclass(frozen=True)
class Deviation:
    """A robot that is farther beside its path than is kept for that.

    Attributes:
        off: How far, for certain: without what noise may feign [m].
        kept: What was kept [m].
        needed: What has to be kept from now on [m].
        clearance: Room that is left about the body, here or, where it comes back, on its way [m].
        returns: Whether it was set there, and comes back; None if it has driven there. False: what
            is between it and its path is not clear.
        slowly: From where to where along the path it has to be slower for that, and how slow.
        turned: By how much it looks another way than its path and can't turn on the spot [rad].
        at: Where it is, if it was set there [m], shape (d,).
        speed: How fast it is there, as measured [m/s].
        was_told: Whether it was told before that it can't come back.
    """

    off: float
    kept: float
    needed: float
    clearance: float
    returns: bool | None = None
    slowly: Slow | None = None
    turned: float = 0.0
    at: tuple[float, ...] = ()
    speed: float = math.inf
    was_told: bool = False


def path_deviation(
    task: DriveTask,
    watch: Watch,
    knowledge: Knowledge,
    schedule: Schedule,
    measured: RobotState,
    place: TruePlace,
    *,
    was_set: bool,
) -> tuple[Watch, Deviation | None]:
    """Whether a robot is farther beside its path than is kept for that.

    Args:
        task: What is asked of the drive.
        watch: So far.
        knowledge: All that is known.
        schedule: What the robot means to do.
        measured: Where it is.
        place: That on its path.
        was_set: Whether it was set there, by hand or by its filter, and has not driven there.
    """
    kept = task.requirements.tracking_error
    noise, turned = noise_of(task.mission.robot)
    reach = 0.0 if task.mission.robot.footprint is None else task.mission.robot.outer_radius
    off = max(place.off - noise - reach * turned, 0.0)
    here = schedule.driven + place.distance
    if was_set:
        turned = looks_away_by(task.mission.robot, schedule.path, place.distance, measured)
        if turned != 0.0:
            return _set_askew(task, watch, knowledge, schedule, measured, place, turned)
    if was_set and off > kept + BESIDE_M:
        return _set_beside(task, watch, knowledge, schedule, measured, place, off)
    if watch.excuse is not None and watch.excuse.brakes:
        return _not_back(task, watch, knowledge, off, measured)
    if watch.excuse is not None and watch.excuse.path is not None and off > kept + BESIDE_M:
        if not _is_still_clear(task, watch.excuse, knowledge, schedule, measured, place):
            return _not_back(task, watch, knowledge, off, measured)
        if watch.excuse.path is not schedule.path:  # it comes back to another one by now
            excuse = watch.excuse._replace(off=off, place=here, path=schedule.path)
            watch = replace(watch, excuse=excuse)
    excused = 0.0 if watch.excuse is None else MARGIN * watch.excuse.left_at(here)
    if watch.excuse is not None and excused < DIED_OUT_M:
        watch = replace(watch, excuse=None)
    if off <= max(kept, excused) + BESIDE_M:
        return watch, None
    needed = max(MARGIN * off + BESIDE_M, kept + LEAST_GROWTH_M)
    room = room_on(knowledge.world, np.asarray(measured.position)[None])
    return watch, Deviation(off, kept, needed, float(room[0]) - task.requirements.outer_radius)


def _set_beside(
    task: DriveTask,
    watch: Watch,
    knowledge: Knowledge,
    schedule: Schedule,
    measured: RobotState,
    place: TruePlace,
    off: float,
) -> tuple[Watch, Deviation]:
    """How one comes back that was set beside its path: as fast as it is, slowly, or not at all."""
    kept, here = task.requirements.tracking_error, schedule.driven + place.distance
    world, at = knowledge.world, np.asarray(measured.position)
    required = task.requirements.outer_radius + task.requirements.clearance
    over, looks = _convergence(task, task.limits.max_speed), _looks(task, schedule, measured, place)
    body, path = task.requirements.outer_radius, schedule.path
    room = room_on(world, way_back(path, place.distance, at, over, looks=looks))
    if is_way_back_clear(room, required, body):
        floor = floor_back(room, required, body)
        watch = replace(watch, excuse=Excuse(off, here, dies_out_over(off, over), floor, path))
        return watch, Deviation(off, kept, kept, float(room.min()) - body, returns=True)
    slow, least = _slowest(task), _convergence(task, 0.0)
    braking = max(measured.ground_speed**2 - slow**2, 0.0) / (2.0 * task.limits.brake)
    braking += measured.ground_speed * task.reaction
    room = room_on(world, way_back(path, place.distance, at, least, braking, looks))
    whole = braking + SETTLED * dies_out_over(off, least)
    if not is_way_back_clear(room, required, body, braking / whole):
        watch = replace(watch, excuse=Excuse(off, here, over))
        return _not_back(task, watch, knowledge, off, measured)
    end, floor = place.distance + whole, floor_back(room, required, body, braking / whole)
    excuse = Excuse(off, here + braking, dies_out_over(off, least), floor, path)
    watch = replace(watch, excuse=excuse)
    slowly = Slow(place.distance + braking, end, slow)
    clearance = float(room.min()) - body
    return watch, Deviation(off, kept, kept, clearance, returns=True, slowly=slowly)


def _not_back(
    task: DriveTask, watch: Watch, knowledge: Knowledge, off: float, measured: RobotState
) -> tuple[Watch, Deviation]:
    """How one stands that can't come back to its path, or has to stand first.

    Args:
        task: What is asked of the drive.
        watch: With since when it is beside its path.
        knowledge: All that is known.
        off: How far it is beside it [m].
        measured: Where it is.
    """
    assert watch.excuse is not None
    kept, at = task.requirements.tracking_error, tuple(measured.position)
    room = float(room_on(knowledge.world, np.array([at]))[0]) - task.requirements.outer_radius
    found = Deviation(
        off, kept, kept, room, returns=False, at=at, speed=measured.ground_speed,
        was_told=watch.excuse.brakes,
    )  # fmt: skip
    return replace(watch, excuse=watch.excuse._replace(brakes=True)), found


def _is_still_clear(
    task: DriveTask,
    excuse: Excuse,
    knowledge: Knowledge,
    schedule: Schedule,
    measured: RobotState,
    place: TruePlace,
) -> bool:
    """Whether a robot on its way back to its path may go on, by all that it knows by now.

    It looks at that again in every step: what it comes by may not have been in sight before, and
    its path may have been laid anew.

    Args:
        task: What is asked of the drive.
        excuse: Since when it is on its way back, and what it keeps there.
        knowledge: All that is known.
        schedule: What it means to do.
        measured: Where it is.
        place: That on its path.
    """
    path, at, body = schedule.path, np.asarray(measured.position), task.requirements.outer_radius
    looks = _looks(task, schedule, measured, place)
    for speed in (measured.ground_speed, 0.0):
        over = _convergence(task, speed)
        room = room_on(knowledge.world, way_back(path, place.distance, at, over, looks=looks))
        if is_way_back_clear(room, min(excuse.floor, body + task.requirements.clearance), body):
            return True
    return False


def _looks(task: DriveTask, schedule: Schedule, measured: RobotState, place: TruePlace) -> float:
    """By how much a robot looks to the left of where its path leads, and drives so [rad].

    One that drives across looks as it likes; one that stands turns first, if it can.
    """
    robot, path = task.mission.robot, schedule.path
    turns_first = robot.turn_radius is None and measured.ground_speed < AT_REST_MPS
    if path.dimension > 2 or robot.held_heading is not None or turns_first:
        return 0.0
    if task.model is not None and task.model.actuators.max_across > 0.0:
        return 0.0
    leads = float(path.heading(path.parameter(place.distance)))
    return math.remainder(measured.heading - leads, math.tau)


def _set_askew(
    task: DriveTask,
    watch: Watch,
    knowledge: Knowledge,
    schedule: Schedule,
    measured: RobotState,
    place: TruePlace,
    turned: float,
) -> tuple[Watch, Deviation]:
    """How one turns to its path that was set down looking another way: as it is, or not at all."""
    kept, body = task.requirements.tracking_error, task.requirements.outer_radius
    over, radius = _convergence(task, task.limits.max_speed), task.mission.robot.turn_radius
    assert radius is not None
    places = ways_to_path(schedule.path, place.distance, measured, turned, radius, over)
    room = room_on(knowledge.world, places)
    off = max(2.0 * radius * math.sin(0.5 * turned) ** 2, place.off)
    returns = is_way_back_clear(room, body + task.requirements.clearance, body)
    if returns:
        watch = replace(watch, excuse=Excuse(off, schedule.driven + place.distance, over + radius))
    clearance = float(room.min()) - body
    return watch, Deviation(off, kept, kept, clearance, returns=returns, turned=turned)


def _slowest(task: DriveTask) -> float:
    """The speed up to which a deviation dies out over the least distance [m/s]."""
    if task.model is None:
        return min(1.0, task.limits.max_speed)
    model = task.model
    return min(model.convergence_distance / model.convergence_time, task.limits.max_speed)


def _convergence(task: DriveTask, speed: float) -> float:
    """The distance over which a deviation dies out [m]."""
    if task.model is None:
        return max(1.0, abs(speed))
    model = task.model
    return max(model.convergence_distance, model.convergence_time * abs(speed))
