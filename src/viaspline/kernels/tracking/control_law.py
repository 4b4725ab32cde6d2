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
from viaspline.kernels.tracking.drive_model import ACKERMANN, Machine, clip, limited
from viaspline.kernels.tracking.drive_motion import HEADING, V, W, X, Y, carried
from viaspline.kernels.tracking.reference_path import (
    ReferencePath,
    beside,
    nearest_on,
    on_reference,
)
from viaspline.kernels.tracking.reference_timing import SpeedProfile, ends_at, profile_at

STEEPEST = 1.0  # a robot beside its path comes back to it at this angle at most [rad]
ASTRAY = 0.7  # a robot that can turn on the spot does, if its heading is off by more [rad]
STILL = 0.004  # an error of the heading at rest that is left as it is [rad]

# what is noted at every step of the controller
TIME, PLACE, SPEED, LOW, HIGH, REST, TO_SPEED, TO_TURN, PROGRESS, ASIDE, ERROR, BEHIND = range(12)
NOTES = 12
# what the controller remembers
LATE, AT, TURN, THEN, PACE, FLOOR = range(6)
MEMORY = 6


def turn_law(curvature: float, aside: float, error: float, aim: float) -> float:
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
        aim: L [m].
    """
    nearer = min(max(1.0 - curvature * aside, 0.3), 3.0)
    ahead = -min(max(0.5 * aside / aim, -STEEPEST), STEEPEST)
    return curvature * math.cos(error) / nearer - 2.0 * (error - ahead) / aim


_turn_law = inlined(turn_law)


@inner
def _aimed(
    machine: Machine,
    reference: ReferencePath,
    note: Floats,
    pose: Floats,
    speed: float,
    accel: float,
    hold: float,
) -> None:
    """The command for a robot that should be moving, held for some time [s]."""
    s, aside, error = note[PROGRESS], note[ASIDE], note[ERROR]
    v = speed + machine.lag * accel + machine.gain * note[BEHIND]
    v = clip(v, 0.0, machine.speed)
    if machine.kind != ACKERMANN:
        if abs(error) > ASTRAY:
            note[TO_SPEED] = 0.0
            note[TO_TURN] = clip(-machine.turn_gain * error, -machine.spot, machine.spot)
            return
        v *= math.cos(error)
    ahead = min(s + pose[V] * (machine.lag + 0.5 * hold), note[HIGH] - 1e-9)
    curvature = on_reference(reference, max(ahead, s))[3]
    aim = max(machine.aim, machine.aim_time * pose[V])
    bend = _turn_law(curvature, aside, error, aim)
    note[TO_SPEED] = v
    note[TO_TURN] = math.atan(machine.length * bend) if machine.kind == ACKERMANN else bend * v
    return


@inner
def _resting(machine: Machine, reference: ReferencePath, note: Floats) -> None:
    """The command for a robot that should stand: it turns to where it goes on."""
    note[TO_SPEED] = 0.0
    if machine.kind == ACKERMANN:
        note[TO_TURN] = math.atan(machine.length * on_reference(reference, note[PROGRESS])[3])
        return
    error = note[ERROR]
    note[TO_TURN] = 0.0
    if abs(error) > STILL:
        note[TO_TURN] = clip(-machine.turn_gain * error, -machine.spot, machine.spot)


@inner
def decide_into(
    machine: Machine,
    reference: ReferencePath,
    profile: SpeedProfile,
    memory: Floats,
    pose: Floats,
    time: float,
    period: float,
    times: Floats,
    speeds: Floats,
    turns: Floats,
    count: int,
    note: Floats,
) -> None:
    """One step of the controller; see ``decide``."""
    x, y, heading, v = pose[X], pose[Y], pose[HEADING], pose[V]
    pose[V], pose[W] = memory[PACE], memory[TURN]
    carried(machine, pose, memory[THEN], time, times, speeds, turns, count)
    memory[TURN], memory[PACE], memory[THEN] = pose[W], v, time
    pose[X], pose[Y], pose[HEADING], pose[V] = x, y, heading, v
    carried(machine, pose, time, time + machine.delay, times, speeds, turns, count)
    now = time + machine.delay
    should, speed, accel = profile_at(profile, now - memory[LATE])
    low, high, stood = ends_at(profile, now - memory[LATE])
    if stood:
        memory[FLOOR] = low
    low = min(low, memory[FLOOR])
    rests = speed == 0.0 and accel == 0.0
    s = should
    if not rests:
        least, most = low, max(high - 1e-9, low)
        s = nearest_on(reference, clip(should, memory[AT] - 0.5, memory[AT] + 1.0), pose[X],
                     pose[Y], least, most)  # fmt: skip
        if should - s > machine.room + machine.room_time * speed:
            memory[LATE] += period
            should, speed, accel = profile_at(profile, now - memory[LATE])
    memory[AT] = s
    note[TIME], note[PLACE], note[SPEED], note[LOW], note[HIGH] = now, should, speed, low, high
    note[REST] = 1.0 if rests else 0.0
    note[PROGRESS], note[BEHIND] = s, should - s
    note[ASIDE], note[ERROR] = beside(reference, s, pose[X], pose[Y], pose[HEADING])
    if rests:
        _resting(machine, reference, note)
    else:
        _, soon, push = profile_at(profile, now + 0.5 * period - memory[LATE])
        _aimed(machine, reference, note, pose, soon, push, period)
    note[TO_SPEED], note[TO_TURN] = limited(machine, note[TO_SPEED], note[TO_TURN])


@kernel
def decide(
    machine: Machine,
    reference: ReferencePath,
    profile: SpeedProfile,
    memory: Floats,
    pose: Floats,
    time: float,
    period: float,
    times: Floats,
    speeds: Floats,
    turns: Floats,
) -> Floats:
    """What a robot is told now.

    Args:
        machine: Its drive; the noise is not looked at.
        reference: Its path.
        profile: Its time law.
        memory: What the controller remembers, shape (MEMORY,), changed in place.
        pose: As measured: X, Y, HEADING, V and W, shape (STATE,); afterwards as predicted for
            when the command takes effect.
        time: Now [s].
        period: Until the next step [s].
        times: When the commands before were given [s], increasing, shape (k,).
        speeds: What they were [m/s], shape (k,).
        turns: As the machine's, shape (k,).

    Returns:
        What is noted, shape (NOTES,): the command under TO_SPEED and TO_TURN.
    """
    note = np.zeros(NOTES)
    decide_into(
        machine,
        reference,
        profile,
        memory,
        pose,
        time,
        period,
        times,
        speeds,
        turns,
        times.shape[0],
        note,
    )
    return note
