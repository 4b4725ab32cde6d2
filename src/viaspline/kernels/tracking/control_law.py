"""What a robot is told: the control law of a robot that follows a path with its time law.

A robot's commands take effect after its delay. So the controller lives that much ahead: it predicts
where the robot will be when its command arrives, by the commands that are still on their way, and
compares that with where it should be then.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined, inner, kernel
from viaspline.kernels.tracking.drive_model import (
    DriveModel,
    clip,
    is_steered,
    limited,
    moves_across,
    wanted_heading,
)
from viaspline.kernels.tracking.drive_motion import ACROSS, ALONG, HEADING, TURN, X, Y, carried
from viaspline.kernels.tracking.reference_path import (
    ReferencePath,
    beside,
    heading_error,
    nearest_on,
    on_reference,
)
from viaspline.kernels.tracking.reference_timing import SpeedProfile, ends_at, profile_at

MAX_APPROACH_RAD = 1.0
"""A robot beside its path comes back to it at this angle at most [rad]."""

ASTRAY_RAD = 0.7
"""A robot that can turn on the spot does, if its heading is off by more [rad]: from its path's, or
from any between that and the one at which it comes back to its path."""

STANDING_MPS, ASTRAY_AT_REST_RAD = 0.02, 0.1
"""One that is slower turns where it is before it sets off, if its heading is off by more: it may
have got another time law while it turned [m/s], [rad]."""

HEADING_DEADBAND_RAD = 0.004
"""An error of the heading at rest that is left as it is [rad]."""

PAST_CORNER_M = 1e-6
"""A robot looks along its path so far behind a rest: the corner at which it turns there may lie
behind the rest by what sums of lengths are rounded by [m]."""

MAX_SPOT_SPEED_MPS = 0.2
"""With which a robot that turns on the spot gets back to it, at most [m/s]."""

MAX_SPOT_WAY_M = 0.2
"""And from no farther: one that was set beside its path would drive where nothing was looked at
[m]."""

# what is noted at every step of the controller
(
    TIME, PLACE, SPEED, LOW, HIGH, REST, NOTED_ALONG, NOTED_TURN, PROGRESS, CROSS_TRACK,
    HEADING_ERROR, ALONG_TRACK, NOTED_ACROSS,
) = range(13)  # fmt: skip
NOTES = 13
# what the controller remembers: how late its clock is, where it was on the path, the turn and the
# speed that it predicted, when, and the last rest that it left
LATE, AT, LAST_TURN, LAST_TIME, LAST_SPEED, FLOOR = range(6)
MEMORY = 6


def turn_law(curvature: float, aside: float, error: float, distance: float) -> float:
    """The curvature of the arc that leads back to a path.

    Feed-forward of the path's curvature, seen from beside it, and feedback: with the offset e to
    the left and the heading error h, near the path it is curvature - e/L² - 2h/L, so that both
    die out, critically damped, over a distance of about L, whatever the speed. It comes back at
    an angle of one radian at most. After Samson, "Control of chained systems", 1995, and de Luca,
    Oriolo and Samson, "Feedback control of a nonholonomic car-like robot", 1998.

    Args:
        curvature: Of the path [1/m].
        aside: How far to the left of it the robot is [m].
        error: Its heading less the path's [rad].
        distance: L [m].
    """
    nearer = min(max(1.0 - curvature * aside, 0.3), 3.0)
    ahead = -min(max(0.5 * aside / distance, -MAX_APPROACH_RAD), MAX_APPROACH_RAD)
    return curvature * math.cos(error) / nearer - 2.0 * (error - ahead) / distance


_turn_law = inlined(turn_law)


@inner
def _under_way(
    model: DriveModel,
    reference: ReferencePath,
    note: Floats,
    pose: Floats,
    speed: float,
    accel: float,
    hold: float,
) -> None:
    """The command for a robot that should be moving, held for some time [s]."""
    s, aside, error = note[PROGRESS], note[CROSS_TRACK], note[HEADING_ERROR]
    # who brakes late is told to stand early, not to go back: that would take away what brings up a
    # robot that is behind, and its clock would wait for it for ever
    v = max(speed + model.lag * accel, 0.0) + model.along_gain * note[ALONG_TRACK]
    v = clip(v, 0.0, model.max_speed)
    now = math.hypot(pose[ALONG], pose[ACROSS])
    ahead = min(s + now * (model.lag + 0.5 * hold), note[HIGH] - 1e-9)
    distance = max(model.convergence_distance, model.convergence_time * now)
    _, _, tangent, curvature = on_reference(reference, max(ahead, s))
    note[NOTED_ACROSS] = 0.0
    if moves_across(model):
        back = clip(-aside / distance, -MAX_APPROACH_RAD, MAX_APPROACH_RAD)
        way = tangent + back - pose[HEADING]
        note[NOTED_ALONG], note[NOTED_ACROSS] = v * math.cos(way), v * math.sin(way)
        note[NOTED_TURN] = clip(-model.heading_gain * error, -model.spot_rate, model.spot_rate)
        return
    if not is_steered(model):
        most = ASTRAY_AT_REST_RAD if now < STANDING_MPS else ASTRAY_RAD
        approach = -clip(0.5 * aside / distance, -MAX_APPROACH_RAD, MAX_APPROACH_RAD)
        meant = clip(error, min(approach, 0.0), max(approach, 0.0))
        if abs(error - meant) > most:
            note[NOTED_ALONG] = 0.0
            note[NOTED_TURN] = clip(-model.heading_gain * error, -model.spot_rate, model.spot_rate)
            return
        v *= math.cos(error)
    bend = _turn_law(curvature, aside, error, distance)
    note[NOTED_ALONG] = v
    note[NOTED_TURN] = bend * v
    if is_steered(model):
        note[NOTED_TURN] = math.atan(model.actuators.wheelbase * bend)


@inner
def _resting(model: DriveModel, reference: ReferencePath, note: Floats, pose: Floats) -> None:
    """The command for a robot that should stand: it turns to where it goes on.

    While it turns it gets to where it should stand, if that is near: what it stopped short of it,
    and what its wheels slip as it turns, it would be beside its path by.
    """
    note[NOTED_ALONG], note[NOTED_ACROSS] = 0.0, 0.0
    if is_steered(model):
        bend = on_reference(reference, note[PROGRESS])[3]
        note[NOTED_TURN] = math.atan(model.actuators.wheelbase * bend)
        return
    error = note[HEADING_ERROR]
    note[NOTED_TURN] = 0.0
    if abs(error) > HEADING_DEADBAND_RAD:
        note[NOTED_TURN] = clip(-model.heading_gain * error, -model.spot_rate, model.spot_rate)
        x, y, _, _ = on_reference(reference, note[PROGRESS])
        dx, dy = x - pose[X], y - pose[Y]
        if math.hypot(dx, dy) > MAX_SPOT_WAY_M:
            return
        c, s = math.cos(pose[HEADING]), math.sin(pose[HEADING])
        gain, most = model.heading_gain, min(MAX_SPOT_SPEED_MPS, model.max_speed)
        note[NOTED_ALONG] = clip(gain * (c * dx + s * dy), -most, most)
        if moves_across(model):
            note[NOTED_ACROSS] = clip(gain * (c * dy - s * dx), -most, most)


@inner
def decide_into(
    model: DriveModel,
    reference: ReferencePath,
    profile: SpeedProfile,
    memory: Floats,
    pose: Floats,
    time: float,
    wait: float,
    period: float,
    commands: Floats,
    count: int,
    note: Floats,
) -> None:
    """One step of the controller; see ``decide``."""
    x, y, heading, along, across = pose[X], pose[Y], pose[HEADING], pose[ALONG], pose[ACROSS]
    pose[ALONG], pose[TURN] = memory[LAST_SPEED], memory[LAST_TURN]
    carried(model, pose, memory[LAST_TIME], time, commands, count)  # the turn is not measured
    memory[LAST_TURN], memory[LAST_SPEED], memory[LAST_TIME] = pose[TURN], along, time
    pose[X], pose[Y], pose[HEADING], pose[ALONG], pose[ACROSS] = x, y, heading, along, across
    now = time + wait + model.delay
    carried(model, pose, time, now, commands, count)
    should, speed, accel = profile_at(profile, now - memory[LATE])
    low, high, stood = ends_at(profile, now - memory[LATE])
    if stood:
        memory[FLOOR] = low
    low = min(low, memory[FLOOR])
    rests = speed == 0.0 and accel == 0.0
    s, least = should, low + PAST_CORNER_M
    if not rests:
        most = max(high - 1e-9, least)
        s = nearest_on(reference, clip(should, memory[AT] - 0.5, memory[AT] + 1.0), pose[X],
                     pose[Y], least, most)  # fmt: skip
        if should - s > model.slack + model.slack_time * speed:
            memory[LATE] += period
            should, speed, accel = profile_at(profile, now - memory[LATE])
    memory[AT] = s
    note[TIME], note[PLACE], note[SPEED], note[LOW], note[HIGH] = now, should, speed, low, high
    note[REST] = 1.0 if rests else 0.0
    note[PROGRESS] = s
    note[ALONG_TRACK] = 0.0 if rests else max(should, least) - s
    looked = s + PAST_CORNER_M if rests else s
    note[CROSS_TRACK], tangent = beside(reference, looked, pose[X], pose[Y])
    note[HEADING_ERROR] = heading_error(pose[HEADING], wanted_heading(model, tangent))
    if rests:
        _resting(model, reference, note, pose)
    else:
        _, soon, push = profile_at(profile, now + 0.5 * period - memory[LATE])
        _under_way(model, reference, note, pose, soon, push, period)
    note[NOTED_ALONG], note[NOTED_ACROSS], note[NOTED_TURN] = limited(
        model, note[NOTED_ALONG], note[NOTED_ACROSS], note[NOTED_TURN]
    )


@kernel
def decide(
    model: DriveModel,
    reference: ReferencePath,
    profile: SpeedProfile,
    memory: Floats,
    pose: Floats,
    time: float,
    wait: float,
    period: float,
    commands: Floats,
) -> Floats:
    """What a robot is told now.

    Args:
        model: Its drive; the noise is not looked at.
        reference: Its path.
        profile: Its time law.
        memory: What the controller remembers, shape (MEMORY,), changed in place.
        pose: As measured: X, Y, HEADING, ALONG and ACROSS, shape (STATE,); afterwards as
            predicted for when the command takes effect.
        time: Now [s].
        wait: So much later the command is given [s]; until then the last one holds.
        period: Until the next step [s].
        commands: Those given before, in order, shape (k, COMMAND).

    Returns:
        What is noted, shape (NOTES,): the command under NOTED_ALONG, NOTED_ACROSS, NOTED_TURN.
    """
    note = np.zeros(NOTES)
    decide_into(
        model, reference, profile, memory, pose, time, wait, period, commands, commands.shape[0],
        note,
    )  # fmt: skip
    return note
