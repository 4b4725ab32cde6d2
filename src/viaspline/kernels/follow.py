"""Following a path with its time law: where the robot should be, the control law, the closed loop.

A robot's commands take effect after its delay. So the controller lives that much ahead: it predicts
where the robot will be when its command arrives, by the commands that are still on their way, and
compares that with where it should be then.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arclength import panel_of
from viaspline.kernels.jit import inner, kernel, within
from viaspline.kernels.motion import (
    ACKERMANN,
    BREATH,
    Machine,
    awake,
    clip,
    limited,
    moved,
    respond,
    turning,
)

Floats = NDArray[np.float64]

SUBSTEP = 0.01
"""Longest step of the motion [s]."""
STEEPEST = 1.0  # a robot beside its path comes back to it at this angle at most [rad]
ASTRAY = 0.7  # a robot that can turn on the spot does, if its heading is off by more [rad]
STILL = 0.004  # an error of the heading at rest that is left as it is [rad]

# what is noted at every step of the controller
TIME, PLACE, SPEED, LOW, HIGH, REST, TO_SPEED, TO_TURN, PROGRESS, ASIDE, ERROR, BEHIND = range(12)
NOTES = 12
# what the controller remembers
LATE, AT, TURN, THEN, PACE, FLOOR = range(6)
MEMORY = 6
# the state of a machine: pose, speed, turn, and the noise of speed and yaw rate
X, Y, HEADING, V, W, SPEED_OFF, YAW_OFF = range(7)
STATE = 7


class Rail(NamedTuple):
    """A path as points close together; a corner has two at the same distance.

    Attributes:
        distance: Along the path [m], not decreasing, shape (n,).
        x: [m], shape (n,).
        y: [m], shape (n,).
        heading: Without jumps of a whole turn [rad], shape (n,).
        curvature: [1/m], shape (n,).
    """

    distance: Floats
    x: Floats
    y: Floats
    heading: Floats
    curvature: Floats


class Law(NamedTuple):
    """A time law: the acceleration is constant from each point to the next."""

    distance: Floats
    speed: Floats
    time: Floats
    acceleration: Floats


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


_turn_law = within(turn_law)


@inner
def _on(rail: Rail, s: float) -> tuple[float, float, float, float]:
    """Place, heading and curvature at a distance along a path; at a corner those after it."""
    i = panel_of(rail.distance, s)
    width = rail.distance[i + 1] - rail.distance[i]
    if width <= 0.0:
        return rail.x[i + 1], rail.y[i + 1], rail.heading[i + 1], rail.curvature[i + 1]
    w = clip((s - rail.distance[i]) / width, 0.0, 1.0)
    first, last = rail.heading[i], rail.heading[i + 1]
    a, b = w * (1.0 - w) * (1.0 - w) * width, -w * w * (1.0 - w) * width
    c = w * w * (3.0 - 2.0 * w)
    x = rail.x[i] + c * (rail.x[i + 1] - rail.x[i]) + a * math.cos(first) + b * math.cos(last)
    y = rail.y[i] + c * (rail.y[i + 1] - rail.y[i]) + a * math.sin(first) + b * math.sin(last)
    bend = rail.curvature[i] + w * (rail.curvature[i + 1] - rail.curvature[i])
    return x, y, first + w * (last - first), bend


@inner
def _nearest(rail: Rail, s: float, x: float, y: float, low: float, high: float) -> float:
    """The distance along a path of the place nearest to a point, sought from ``s`` on."""
    s = clip(s, low, high)
    for _ in range(12):
        px, py, heading, curvature = _on(rail, s)
        cosine, sine = math.cos(heading), math.sin(heading)
        along = (x - px) * cosine + (y - py) * sine
        aside = (y - py) * cosine - (x - px) * sine
        step = along / max(1.0 - curvature * aside, 0.5)
        to = clip(s + clip(step, -0.5, 0.5), low, high)
        if abs(to - s) < 1e-8:
            return to
        s = to
    return s


@inner
def _beside(rail: Rail, s: float, x: float, y: float, heading: float) -> tuple[float, float]:
    """How far to the left of its place on a path a robot is, and its heading error."""
    px, py, ahead, _ = _on(rail, s)
    aside = (y - py) * math.cos(ahead) - (x - px) * math.sin(ahead)
    error = heading - ahead
    return aside, error - 2.0 * math.pi * math.floor(error / (2.0 * math.pi) + 0.5)


@inner
def _law_at(law: Law, time: float) -> tuple[float, float, float]:
    """Distance, speed and acceleration at a time; at rest before the law begins and after it."""
    n = law.time.shape[0]
    if time < law.time[0]:
        return law.distance[0], law.speed[0], 0.0
    if time >= law.time[n - 1]:
        return law.distance[n - 1], law.speed[n - 1], 0.0
    i = panel_of(law.time, time)
    late, a = time - law.time[i], law.acceleration[i]
    distance = law.distance[i] + (law.speed[i] + 0.5 * a * late) * late
    speed = max(law.speed[i] + a * late, 0.0)
    return clip(distance, law.distance[i], law.distance[i + 1]), speed, a


@inner
def _ends(law: Law, time: float) -> tuple[float, float, bool]:
    """The rests before and after a time [m], between which the robot is on its way.

    The law may begin under way; then the first is its beginning, and the last value is false.
    """
    n = law.time.shape[0]
    i = panel_of(law.time, time)
    first = i
    while first > 0 and law.speed[first] > 0.0:
        first -= 1
    last = i + 1
    while last < n - 1 and (law.speed[last] > 0.0 or law.time[last] <= time):
        last += 1
    return law.distance[first], law.distance[last], law.speed[first] <= 0.0


@inner
def _carried(
    machine: Machine,
    pose: Floats,
    begin: float,
    end: float,
    times: Floats,
    speeds: Floats,
    turns: Floats,
    count: int,
) -> None:
    """Let a machine go on from ``begin`` to ``end`` by the commands that take effect then.

    Args:
        machine: Without its noise.
        pose: X, Y, HEADING, V and W, changed in place.
        begin: [s].
        end: [s].
        times: When each command was given, increasing, the first ``count`` of them [s].
        speeds: [m/s].
        turns: As the machine's.
        count: How many commands there are.
    """
    if end <= begin:
        return
    steps = math.ceil((end - begin) / SUBSTEP - 1e-6)
    seconds = (end - begin) / steps
    k = count - 1
    while k >= 0 and times[k] + machine.delay > begin + 0.5 * seconds:
        k -= 1
    for i in range(steps):
        now = begin + (i + 0.5) * seconds
        while k + 1 < count and times[k + 1] + machine.delay <= now:
            k += 1
        to_speed, to_turn = pose[V], pose[W]
        if k >= 0:
            to_speed, to_turn = limited(machine, speeds[k], turns[k])
        v, w = respond(machine, pose[V], pose[W], to_speed, to_turn, seconds)
        mean = 0.5 * (pose[V] + v)
        rate = turning(machine, mean, 0.5 * (pose[W] + w))
        pose[X], pose[Y], pose[HEADING] = moved(
            pose[X], pose[Y], pose[HEADING], mean, rate, seconds
        )
        pose[V], pose[W] = v, w


@inner
def _aimed(
    machine: Machine,
    rail: Rail,
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
    curvature = _on(rail, max(ahead, s))[3]
    aim = max(machine.aim, machine.aim_time * pose[V])
    bend = _turn_law(curvature, aside, error, aim)
    note[TO_SPEED] = v
    note[TO_TURN] = math.atan(machine.length * bend) if machine.kind == ACKERMANN else bend * v
    return


@inner
def _resting(machine: Machine, rail: Rail, note: Floats) -> None:
    """The command for a robot that should stand: it turns to where it goes on."""
    note[TO_SPEED] = 0.0
    if machine.kind == ACKERMANN:
        note[TO_TURN] = math.atan(machine.length * _on(rail, note[PROGRESS])[3])
        return
    error = note[ERROR]
    note[TO_TURN] = 0.0
    if abs(error) > STILL:
        note[TO_TURN] = clip(-machine.turn_gain * error, -machine.spot, machine.spot)


@inner
def _decide(
    machine: Machine,
    rail: Rail,
    law: Law,
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
    _carried(machine, pose, memory[THEN], time, times, speeds, turns, count)
    memory[TURN], memory[PACE], memory[THEN] = pose[W], v, time
    pose[X], pose[Y], pose[HEADING], pose[V] = x, y, heading, v
    _carried(machine, pose, time, time + machine.delay, times, speeds, turns, count)
    now = time + machine.delay
    should, speed, accel = _law_at(law, now - memory[LATE])
    low, high, stood = _ends(law, now - memory[LATE])
    if stood:
        memory[FLOOR] = low
    low = min(low, memory[FLOOR])
    rests = speed == 0.0 and accel == 0.0
    s = should
    if not rests:
        least, most = low, max(high - 1e-9, low)
        s = _nearest(rail, clip(should, memory[AT] - 0.5, memory[AT] + 1.0), pose[X],
                     pose[Y], least, most)  # fmt: skip
        if should - s > machine.room + machine.room_time * speed:
            memory[LATE] += period
            should, speed, accel = _law_at(law, now - memory[LATE])
    memory[AT] = s
    note[TIME], note[PLACE], note[SPEED], note[LOW], note[HIGH] = now, should, speed, low, high
    note[REST] = 1.0 if rests else 0.0
    note[PROGRESS], note[BEHIND] = s, should - s
    note[ASIDE], note[ERROR] = _beside(rail, s, pose[X], pose[Y], pose[HEADING])
    if rests:
        _resting(machine, rail, note)
    else:
        _, soon, push = _law_at(law, now + 0.5 * period - memory[LATE])
        _aimed(machine, rail, note, pose, soon, push, period)
    note[TO_SPEED], note[TO_TURN] = limited(machine, note[TO_SPEED], note[TO_TURN])


@kernel
def decide(
    machine: Machine,
    rail: Rail,
    law: Law,
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
        rail: Its path.
        law: Its time law.
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
    _decide(
        machine, rail, law, memory, pose, time, period, times, speeds, turns, times.shape[0], note
    )
    return note


@inner
def _move(
    machine: Machine,
    state: Floats,
    begin: float,
    seconds: float,
    first: int,
    last: int,
    times: Floats,
    speeds: Floats,
    turns: Floats,
    count: int,
    noise: Floats,
    track: Floats,
) -> None:
    """The true motion in the steps ``first`` to ``last``; see ``move``."""
    fade = math.exp(-seconds / BREATH)
    fresh = math.sqrt(1.0 - fade * fade)
    k = count - 1
    while k >= 0 and times[k] + machine.delay > begin + 0.5 * seconds:
        k -= 1
    for i in range(first, last):
        end = begin + (i - first + 1) * seconds
        while k + 1 < count and times[k + 1] + machine.delay <= end - 0.5 * seconds:
            k += 1
        to_speed, to_turn = 0.0, state[W]
        if machine.kind != ACKERMANN:
            to_turn = 0.0
        if k >= 0:
            to_speed, to_turn = limited(machine, speeds[k], turns[k])
        v, w = respond(machine, state[V], state[W], to_speed, to_turn, seconds)
        mean = 0.5 * (state[V] + v)
        rate = turning(machine, mean, 0.5 * (state[W] + w))
        state[V], state[W] = v, w
        state[SPEED_OFF] = fade * state[SPEED_OFF] + fresh * machine.speed_noise * noise[i, 0]
        state[YAW_OFF] = fade * state[YAW_OFF] + fresh * machine.yaw_noise * noise[i, 1]
        share = awake(machine, mean, rate)
        mean += share * state[SPEED_OFF]
        rate += share * state[YAW_OFF]
        state[X], state[Y], state[HEADING] = moved(
            state[X], state[Y], state[HEADING], mean, rate, seconds
        )
        track[i, 0], track[i, 1], track[i, 2], track[i, 3] = end, state[X], state[Y], state[HEADING]
        track[i, 4], track[i, 5] = mean, rate


@kernel
def move(
    machine: Machine,
    state: Floats,
    begin: float,
    seconds: float,
    times: Floats,
    speeds: Floats,
    turns: Floats,
    noise: Floats,
) -> Floats:
    """The true motion of a machine, as it is commanded.

    Args:
        machine: The drive, with its noise.
        state: Shape (STATE,), changed in place.
        begin: [s].
        seconds: Each step takes [s].
        times: When the commands were given [s], increasing, shape (k,).
        speeds: What they were [m/s], shape (k,).
        turns: As the machine's, shape (k,).
        noise: Standard normal numbers for speed and yaw rate in every step, shape (n, 2).

    Returns:
        After every step time, x, y, heading, and the speed and yaw rate in it, shape (n, 6).
    """
    n = noise.shape[0]
    track = np.empty((n, 6))
    _move(machine, state, begin, seconds, 0, n, times, speeds, turns, times.shape[0], noise, track)
    return track


@kernel
def drive(
    machine: Machine,
    rail: Rail,
    law: Law,
    state: Floats,
    period: float,
    substeps: int,
    measured: Floats,
    noise: Floats,
) -> tuple[Floats, Floats, int]:
    """A whole drive along a path: measure, decide, move, until the time law is over.

    Args:
        machine: The drive, with its noise.
        rail: The path.
        law: The time law; it begins at time 0.
        state: At the start, shape (STATE,), changed in place.
        period: Of the controller [s].
        substeps: Of the motion in a period.
        measured: Errors of the measured x, y and heading in every period, shape (n, 3).
        noise: Standard normal numbers, shape (n * substeps, 2).

    Returns:
        The track, as of ``move``, and what was noted in every period, both as long as the drive;
        the number of periods, -1 if it was not over after n.
    """
    n = measured.shape[0]
    track, notes = np.empty((n * substeps, 6)), np.zeros((n, NOTES))
    times, speeds, turns = np.empty(n), np.empty(n), np.empty(n)
    memory, pose, note = np.zeros(MEMORY), np.zeros(STATE), np.zeros(NOTES)
    memory[LATE], memory[TURN] = machine.delay, state[W]
    end = law.time[law.time.shape[0] - 1]
    for tick in range(n):
        time = tick * period
        if time - memory[LATE] >= end:
            return track, notes, tick
        for k in range(3):
            pose[k] = state[k] + measured[tick, k]
        pose[V] = state[V]
        _decide(machine, rail, law, memory, pose, time, period, times, speeds, turns, tick, note)
        for k in range(NOTES):
            notes[tick, k] = note[k]
        times[tick], speeds[tick], turns[tick] = time, note[TO_SPEED], note[TO_TURN]
        _move(
            machine, state, time, period / substeps, tick * substeps, (tick + 1) * substeps, times,
            speeds, turns, tick + 1, noise, track,
        )  # fmt: skip
    return track, notes, -1


@kernel
def deviations(rail: Rail, notes: Floats, track: Floats) -> Floats:
    """How far beside, turned from and behind its path a machine really was.

    Args:
        rail: The path.
        notes: Of every period, shape (m, NOTES).
        track: Of every step, shape (n, 6).

    Returns:
        Distance along the path, distance from the path, positive to the left, heading error,
        distance behind where it should be, and 1 where it should stand, shape (n, 5).
    """
    out = np.zeros((track.shape[0], 5))
    k = -1
    s = low = notes[0, LOW]
    for i in range(track.shape[0]):
        time, x, y = track[i, 0], track[i, 1], track[i, 2]
        while k + 1 < notes.shape[0] and notes[k + 1, TIME] <= time + 1e-9:
            k += 1
        should, rests = notes[0, PLACE], True
        if k >= 0:
            should = notes[k, PLACE] + notes[k, SPEED] * (time - notes[k, TIME])
            rests = notes[k, REST] > 0.0
        high = should
        if not rests:
            low, high = notes[k, LOW], max(notes[k, HIGH] - 1e-9, notes[k, LOW])
            should = min(should, high)
        s = _nearest(rail, clip(should, s - 0.5, s + 0.5), x, y, low, high)
        px, py, _, _ = _on(rail, s)
        aside, error = _beside(rail, s, x, y, track[i, 3])
        out[i, 0], out[i, 2] = s, error
        out[i, 1] = math.copysign(math.hypot(x - px, y - py), aside)
        out[i, 3], out[i, 4] = should - s, 1.0 if rests else 0.0
    return out
