"""How one robot drives to where it may go: along its fastest law, and ready to stop before the end.

The square of the speed changes linearly with the distance all along, so a drive is exact: a robot
speeds up as hard as it may to the least of what its law, a disturbance and its grant allow; and
where it is over the first two, it slows down as hard as it may. The braking curve before the end of
its grant falls as fast as that, so no robot ever leaves it.

Tested through ``fleet/execution/test_simulate_fleet``.
"""

from __future__ import annotations

import math
from typing import Final, NamedTuple

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.fleet.packed_courses import PackedCourses
from viaspline.kernels.fleet.packed_rides import PackedRides
from viaspline.kernels.jit import inlined, inner

NEAR_M: Final = 1e-9
"""So near the end of its grant a robot stands there."""
NEAR_SQUARE: Final = 1e-12
"""So little over a curve a robot is on it [m²/s²], unless its law itself is hardly faster."""
NEAR_SHARE: Final = 1e-3
"""Of the square of the speed that its law has where it is slowest, but not at rest."""
SLOWEST: Final = 1e-4
"""A robot that is slowed down to less than this part of its speed doesn't drive [1]."""


class PackedDrive(NamedTuple):
    """Where the robots of a fleet are and how fast; all of it is written to.

    Attributes:
        cell: The node at which the robot is, or after which it is, (n,).
        place: How far it has come [m], (n,).
        square: Of its speed [m²/s²], (n,).
        rests_until: How long it stands at a node, or after a halt [s], (n,).
        halts: How long it has to halt as soon as it stands [s]; 0: it needn't, (n,).
        served: Whether it has stood at its node for as long as it has to, (n,).
        arrived: When it came to its end [s]; infinite: it hasn't yet, (n,).
        slope: Of the square of its speed with the distance, just now [m/s²], (n,).
    """

    cell: Ints
    place: Floats
    square: Floats
    rests_until: Floats
    halts: Floats
    served: Flags
    arrived: Floats
    slope: Floats


class PackedTrouble(NamedTuple):
    """What goes wrong under way.

    Attributes:
        pace: The part of its speed with which a robot drives the cell after a node, (nodes,).
        halts: How long it halts from a node on [s]; 0: not at all, (nodes,).
        lost: The part of all messages that get lost.
        seed: Of what is lost when.
    """

    pace: Floats
    halts: Floats
    lost: float
    seed: int


@inner
def new_drive(courses: PackedCourses, rides: PackedRides, trouble: PackedTrouble) -> PackedDrive:
    """Robots that stand at their starts."""
    count = courses.reach.size
    drive = PackedDrive(
        np.empty(count, np.int64), np.zeros(count), np.zeros(count), np.empty(count),
        np.zeros(count), np.zeros(count, np.bool_), np.full(count, np.inf), np.zeros(count),
    )  # fmt: skip
    for robot in range(count):
        drive.halts[robot] = trouble.halts[courses.first[robot]]
        drive.cell[robot] = courses.first[robot]
        drive.rests_until[robot] = rides.depart[robot]
    return drive


@inlined
def _rise(
    here: float, top: float, top_slope: float, room: float, speeds_up: float, slows_down: float,
    near: float,
) -> tuple[float, float]:  # fmt: skip
    """How the square of a speed goes on, and how far like that at most.

    Args:
        here: The square of the speed [m²/s²].
        top: What it may be here.
        top_slope: How that changes along the cell [m/s²].
        room: Up to where the robot may go [m].
        speeds_up: The steepest slope up [m/s²].
        slows_down: The steepest slope down.
        near: By so much the square of a speed is rounded [m²/s²].

    Returns:
        The slope [m/s²], and after how many metres another holds.
    """
    brakes = slows_down * room
    if here > top + near:
        until = here / slows_down
        if top_slope + slows_down > 0.0:
            until = min(until, (here - top) / (top_slope + slows_down))
        return -slows_down, until
    if here >= brakes - near:
        return -slows_down, here / slows_down
    if here >= top - near and top_slope <= speeds_up:
        slope = top_slope
        until = np.inf
    else:
        slope = speeds_up
        until = (top - here) / (slope - top_slope) if slope > top_slope else np.inf
    if slope + slows_down > 0.0:
        until = min(until, (brakes - here) / (slope + slows_down))
    return slope, until


@inlined
def _near_square(rides: PackedRides, node: int, pace: float) -> float:
    """By how much the square of a speed is rounded in the cell behind a node [m²/s²].

    At the tip of a turn on the spot a law may have less than a micrometre a second.
    """
    slow, fast = rides.square[node], rides.square[node + 1]
    if slow == 0.0 or 0.0 < fast < slow:
        slow = fast
    if slow == 0.0:
        return NEAR_SQUARE
    return min(NEAR_SQUARE, NEAR_SHARE * slow * (pace * pace if pace >= SLOWEST else 1.0))


@inlined
def enters_node(
    drive: PackedDrive, courses: PackedCourses, trouble: PackedTrouble, robot: int, node: int
) -> None:
    """A robot comes to a node."""
    drive.cell[robot] = node
    drive.place[robot] = courses.distance[node]
    drive.served[robot] = False
    drive.halts[robot] = max(drive.halts[robot], trouble.halts[node])


@inlined
def drive_stretch(
    drive: PackedDrive, courses: PackedCourses, rides: PackedRides, trouble: PackedTrouble,
    robot: int, grant: float, now: float, until: float,
) -> float:  # fmt: skip
    """Drive on with one acceleration, or stand, for as long as that lasts.

    Args:
        drive: It is written to.
        courses: PackedCourses.
        rides: PackedRides.
        trouble: PackedTrouble.
        robot: Which.
        grant: How far it may go [m].
        now: The time [s].
        until: No longer than until then [s].

    Returns:
        The time at the end [s].
    """
    node, last = drive.cell[robot], courses.first[robot + 1] - 1
    square = drive.square[robot]
    drive.slope[robot] = 0.0
    if square == 0.0:
        if drive.halts[robot] > 0.0:
            drive.rests_until[robot] = max(drive.rests_until[robot], now) + drive.halts[robot]
            drive.halts[robot] = 0.0
        at_node = drive.place[robot] <= courses.distance[node]
        if at_node and not drive.served[robot] and now >= drive.rests_until[robot]:
            drive.served[robot] = True
            drive.rests_until[robot] = now + rides.stays[node]
        if now < drive.rests_until[robot]:
            return min(until, drive.rests_until[robot])
    if node == last:
        drive.arrived[robot] = min(drive.arrived[robot], now)
        return until
    end = courses.distance[node + 1]
    width = end - courses.distance[node]
    pace = trouble.pace[node] if drive.halts[robot] == 0.0 else 0.0
    left = end - drive.place[robot]
    if left <= NEAR_M:
        enters_node(drive, courses, trouble, robot, node + 1)
        if rides.square[node + 1] > 0.0 or square == 0.0:
            return now
        drive.square[robot] = 0.0  # what is left of its braking takes its time
        drive.slope[robot] = -square / max(left, NEAR_M)
        return min(now + 2.0 * left / math.sqrt(square), until)
    room = grant - drive.place[robot]
    if square == 0.0 and (room <= NEAR_M or pace < SLOWEST):
        if 0.0 < room <= NEAR_M:
            drive.place[robot] = grant  # others may wait for it to be just there
        return until
    if rides.square[node] == 0.0 and rides.square[node + 1] == 0.0:  # from rest to rest
        top, slope = np.inf, 0.0
        room = min(room, end - drive.place[robot])
    else:
        slope = (rides.square[node + 1] - rides.square[node]) / width * pace * pace
        top = rides.square[node] * pace * pace
        top += slope * (drive.place[robot] - courses.distance[node])
    near = _near_square(rides, node, pace)
    speeds_up, slows_down = 2.0 * rides.accel[robot], 2.0 * rides.brake[robot]
    rise, far = _rise(square, top, slope, room, speeds_up, slows_down, near)
    ends = far >= left
    far = min(far, left)
    speed = math.sqrt(square)
    then = max(square + rise * far, 0.0)
    if then < near or (ends and rides.square[node + 1] == 0.0):
        then = 0.0
        rise = -square / far if far > 0.0 else rise
    if speed == 0.0 and then == 0.0:
        return until  # it can't go on before its grant grows
    drive.slope[robot] = rise
    lasts = 2.0 * far / (speed + math.sqrt(then))
    if now + lasts > until:
        late = until - now
        drive.place[robot] = min(drive.place[robot] + (speed + 0.25 * rise * late) * late, end)
        square = max(speed + 0.5 * rise * late, 0.0) ** 2
        has_stopped = rise <= 0.0 and square < near  # else a hair of speed is kept for ever
        drive.square[robot] = 0.0 if has_stopped else square
        return until
    drive.square[robot] = then
    if ends:
        enters_node(drive, courses, trouble, robot, node + 1)
    else:
        drive.place[robot] += far
    return now + lasts
