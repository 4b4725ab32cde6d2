"""What a machine does, beside what it was told: jumps of its pose, speed that isn't reached, delay.

Tested through ``robot/watching/test_model_watch``.
"""

from __future__ import annotations

import math
from dataclasses import replace

from viaspline.machine.drive_noise import MAX_DEVIATIONS
from viaspline.mission.robot_parts import RobotSpec
from viaspline.robot.navigation.drive_task import DriveTask
from viaspline.robot.navigation.track_path import STANDSTILL_MPS
from viaspline.robot.run import Event
from viaspline.robot.state import RobotState
from viaspline.robot.watching.watch import TrailMark, Watch

JUMP_M, JUMP_RAD = 0.1, 0.2
"""What a pose moves at once beyond what the robot can drive, for it to be a jump [m], [rad];"""

JUMP_SPEED_SHARE = 0.25
"""and more by this share of what it drives between two steps;"""

MAX_YAW_RATE_RADPS = 4.0
"""and of what it turns at the most, of a robot without a limit of that [rad/s]."""

SLIP_S = 1.5
"""For so long what a robot drives is compared with what it was told [s]."""

SLIP_RATIO, SLIP_RATIO_WITHOUT_DRIVE = 0.5, 0.35
"""Of what it was told, less than which is slip. Where delay and lag aren't known it may be less."""

SLIP_OVER_RATIO = 0.8
"""With more than this it is over."""

TOLD_AGAIN_S = 10.0
"""What comes and goes is told of again after so long [s]."""

LEAST_MEANT_M = 0.12
"""So much it has to have been told to drive, to compare that [m]."""

MARK_S = 0.1
"""From mark to mark [s]."""

LAG_S = 1.0
"""A robot that is so far behind its first time law is told of; then at every doubling [s]."""

WAIT_M, WAIT_S = 0.25, 0.15
"""So far behind, and for its speed, a robot without a drive has its time law wait, as that of one
with a drive does [m], [s];"""

WAIT_AT_REST_M, WAIT_SLOWLY_S = 0.02, 0.4
"""and less far where it is slow: else it would stop short of its goal [m], [s]."""


def noise_of(robot: RobotSpec) -> tuple[float, float]:
    """By how much a measured position [m] and heading [rad] may be off."""
    place = robot.localization
    if place is None:
        return 0.0, 0.0
    heading = math.radians(place.heading_noise_deg)
    return MAX_DEVIATIONS * place.position_noise_m, MAX_DEVIATIONS * heading


def pose_jump(
    task: DriveTask, watch: Watch, last: RobotState, measured: RobotState, seconds: float
) -> tuple[float, float] | None:
    """By how much a pose has jumped [m], [rad]; None if the robot may have driven there.

    Args:
        task: What is asked of the drive.
        watch: Of the step before.
        last: What was measured then.
        measured: What is measured now.
        seconds: Between both [s].
    """
    noise, turned_noise = noise_of(task.mission.robot)
    turned = math.remainder(measured.heading - last.heading, math.tau)
    middle = last.heading + 0.5 * turned
    dx, dy = (b - a for a, b in zip(last.position[:2], measured.position[:2], strict=True))
    along = dx * math.cos(middle) + dy * math.sin(middle)
    aside = dy * math.cos(middle) - dx * math.sin(middle)
    fastest = max(abs(measured.speed), abs(last.speed), watch.speed)
    across = max(abs(measured.speed_across), abs(last.speed_across))
    reach = (1.0 + JUMP_SPEED_SHARE) * fastest * seconds
    beyond = max(abs(along) - reach, 0.0)
    sideways = max(abs(aside) - (1.0 + JUMP_SPEED_SHARE) * across * seconds, 0.0)
    far = math.hypot(beyond, sideways)
    rate = task.limits.max_yaw_rate
    most = 2.0 * (MAX_YAW_RATE_RADPS if rate is None else rate) * seconds
    allowed = JUMP_M + 2.0 * noise + JUMP_SPEED_SHARE * fastest * seconds
    if task.model is None and rate is None and watch.command_at(watch.time) == 0.0:
        most = math.inf  # it stands, and nothing says that it doesn't turn there at once
    if far <= allowed and abs(turned) <= most + JUMP_RAD + 2.0 * turned_noise:
        return None
    driven = 0.5 * (last.speed + measured.speed) * seconds
    return math.hypot(along - driven, aside), turned


def meant_speed(task: DriveTask, watch: Watch, time: float, seconds: float) -> float:
    """The speed that a robot should have by its commands [m/s].

    Args:
        task: What is asked of the drive.
        watch: Of the step before.
        time: Now [s].
        seconds: Since then [s].
    """
    model = task.model
    if model is None:
        return watch.command_at(time)
    told = watch.command_at(time - 0.5 * seconds - model.delay)
    share = 1.0 if model.lag <= 0.0 else 1.0 - math.exp(-seconds / model.lag)
    most = model.max_accel * seconds
    return watch.speed + min(max((told - watch.speed) * share, -most), most)


def remembered_for(task: DriveTask) -> float:
    """For how long commands act on, as far as is known [s]."""
    return 1.0 if task.model is None else 1.0 + task.model.delay


def slipping(
    task: DriveTask, watch: Watch, where: tuple[float, ...]
) -> tuple[Watch, tuple[Event, ...]]:
    """Whether a robot drives less than it was told, in the last ``SLIP_S``.

    Args:
        task: What is asked of the drive.
        watch: With where the robot is now, and what it was meant to have driven.
        where: That place [m], shape (d,).
    """
    now = TrailMark(watch.time, watch.place, watch.meant)
    first = next((mark for mark in reversed(watch.trail) if mark.time <= now.time - SLIP_S), None)
    kept = tuple(mark for mark in watch.trail if first is None or mark.time >= first.time)
    if not kept or now.time - kept[-1].time >= MARK_S - 1e-9:
        kept = (*kept, now)
    watch = replace(watch, trail=kept)
    if first is None:
        return watch, ()
    seconds, meant = now.time - first.time, now.meant - first.meant
    if meant < LEAST_MEANT_M + 2.0 * noise_of(task.mission.robot)[0]:
        return watch, ()
    ratio = (now.place - first.place) / meant
    least = SLIP_RATIO_WITHOUT_DRIVE if task.model is None else SLIP_RATIO
    if ratio > SLIP_OVER_RATIO and now.time >= watch.told.get("slip", -math.inf) + TOLD_AGAIN_S:
        return watch.without_telling("slip"), ()
    if ratio >= least or "slip" in watch.told:
        return watch, ()
    told, done = meant / seconds, (now.place - first.place) / seconds
    words = (
        f"drives at {done:.2f} m/s where it is told to drive at {told:.2f} m/s: it slips or is held"
    )
    data = {"ratio": ratio, "commanded_mps": told, "measured_mps": done, "over_s": seconds}
    event = Event("slip", watch.time, where, words, data)
    return watch.having_told("slip", now.time), (event,)


def lagging(
    watch: Watch, waited: float, where: tuple[float, ...], behind: float
) -> tuple[Watch, tuple[Event, ...]]:
    """How far a robot is behind its first time law.

    Args:
        watch: So far.
        waited: For how long the time law has waited in this step [s].
        where: The robot is [m], shape (d,).
        behind: How far it is behind its place now [m].
    """
    watch = replace(watch, behind=watch.behind + waited)
    least = 2.0 * watch.told["lag"] if "lag" in watch.told else LAG_S
    if watch.behind < least:
        return watch, ()
    words = f"is {watch.behind:.1f} s behind its first time law, which waits for it"
    data = {"behind_s": watch.behind, "behind_m": behind}
    return watch.having_told("lag", watch.behind), (Event("lag", watch.time, where, words, data),)


def waits_for(watch: Watch, reached: float, seconds: float) -> float:
    """For how long the time law of a robot without a drive waits in a step [s].

    Where its law has it can't lie behind what it was taken to have reached: else it would be taken
    for being there when it is not.

    Args:
        watch: With where the robot is.
        reached: Where it was taken to be in the step before, along all that is driven [m].
        seconds: Since then [s].
    """
    behind = reached - watch.place
    if watch.speed <= STANDSTILL_MPS:  # it stands as it was told: it comes no nearer
        return 0.0
    least = min(WAIT_M, WAIT_AT_REST_M + WAIT_SLOWLY_S * watch.speed) + WAIT_S * watch.speed
    return max(seconds, 0.0) if behind > least else 0.0
