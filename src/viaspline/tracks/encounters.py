"""How near a driven robot came to what moves, and what touched it.

Tested through ``tracks/test_encounters``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.mission.robot_parts import RobotSpec
from viaspline.tracks.calm_moments import Stretches, spread_moments
from viaspline.tracks.encountered import Contact, Encounters, Pass

RESOLUTION_S = 1e-3
"""Between two instants that are looked at."""

AT_ONCE = 50_000
"""Instants that are looked at together."""

STANDING_MPS = 1e-3
"""A robot that is slower stands [m/s]."""

PASSING_RESOLUTION_S = 0.01
"""Between two instants at which it is looked how near each thing is."""

WasLate = Callable[[int, float], bool]
"""Of what touched the robot, by its index, and when [s]."""


class Movers(Protocol):
    """Things that move, numbered."""

    @property
    def top_speed(self) -> float:
        """Of any of them [m/s]."""

    def __len__(self) -> int:
        """How many they are."""

    def name(self, index: int) -> str:
        """What one is called."""

    def alone(self, index: int) -> Movers:
        """One of them."""

    def nearest(self, places: Floats, times: Floats) -> tuple[Floats, Ints]:
        """Of places (n, d) at times (n,): distances [m] to the nearest, and its number or -1."""

    def distance(self, places: Floats, times: Floats) -> Floats:
        """These distances."""


@dataclass(frozen=True)
class DrivenStates:
    """Where a robot was at every time.

    Attributes:
        begin: When it set off [s].
        end: When it arrived, or was stopped [s].
        state_at: Its places [m], (n, d), and its speeds [m/s], (n,), at times [s], (n,).
        calm: When it stands, nothing touches it and nothing is nearer than at another time in
            which it stands there; it needn't be looked at closely then.
    """

    begin: float
    end: float
    state_at: Callable[[Floats], tuple[Floats, Floats]]
    calm: Stretches = ()

    def moments(self, apart: float) -> Floats:
        """Moments of the drive, no farther apart than so long where it isn't calm [s]."""
        count = max(math.ceil((self.end - self.begin) / apart), 1)
        return spread_moments(self.begin, self.end, count, self.calm)


def encounters(
    motion: DrivenStates, robot: RobotSpec, radius: float, moving: Movers, was_late: WasLate
) -> Encounters:
    """How near a drive came to what moves.

    The distance changes by no more than both can go in the time between two instants, so what is
    measured there, less that, is proven for all of the drive; what jumps, where a motion begins
    again, counts from when it is there.

    Args:
        motion: Where the robot was when.
        robot: How it brakes.
        radius: Of the disc or ball that its body is; 0 where distances are to its body as it
            is [m].
        moving: All that moved, known or not.
        was_late: Whether something could not be seen until the robot couldn't stand in time any
            more before it was touched at a time; see ``Appearance``.
    """
    if not len(moving):
        return Encounters(math.inf, None, None, ())
    times = motion.moments(RESOLUTION_S)
    count, step = len(times), float(times[1] - times[0])
    gaps, nearest, speeds = np.empty(count), np.empty(count, np.int64), np.empty(count)
    for first in range(0, count, AT_ONCE):
        part = slice(first, first + AT_ONCE)
        places, speeds[part] = motion.state_at(times[part])
        gaps[part], nearest[part] = moving.nearest(places, times[part])
    gaps -= radius
    k = int(gaps.argmin())
    if nearest[k] < 0:
        return Encounters(math.inf, None, None, ())
    apart = 0.5 * step * (float(speeds.max()) + moving.top_speed)
    contacts = _contacts(times, gaps, nearest, speeds, moving, was_late)
    name, proven = moving.name(int(nearest[k])), float(gaps[k]) - apart
    passes = _passes(motion, robot, radius, moving, proven)
    return Encounters(proven, float(times[k]), name, contacts, passes)


def touched_by(met: Encounters | None) -> str | None:
    """Why a drive in which something was touched is none that reached its goal; None: it wasn't."""
    for contact in () if met is None else met.contacts:
        if contact.robot_speed > 0.0:
            return (
                f"the robot touched '{contact.obstacle}', which moves, at {contact.time:.2f} s "
                f"and {contact.robot_speed:.2f} m/s"
            )
    return None


def _contacts(
    times: Floats,
    gaps: Floats,
    nearest: Ints,
    speeds: Floats,
    moving: Movers,
    was_late: WasLate,
) -> tuple[Contact, ...]:
    """Each touch, from its beginning, with how fast the robot was."""
    touching = gaps < 0.0
    begins = np.flatnonzero(touching & ~np.concatenate(([False], touching[:-1])))
    found = []
    for k in begins.tolist():
        index, time = int(nearest[k]), float(times[k])
        late = was_late(index, time)
        found.append(Contact(time, moving.name(index), _speed_told(float(speeds[k])), late))
    return tuple(found)


def _passes(
    motion: DrivenStates, robot: RobotSpec, radius: float, moving: Movers, proven: float
) -> tuple[Pass, ...]:
    """What came near to the robot, each by where it was nearest; none nearer than is proven of all.

    Of each it is looked less often how near it was, which proves less.
    """
    times = motion.moments(PASSING_RESOLUTION_S)
    places, speeds = motion.state_at(times)
    near = robot.max_speed_mps**2 / (2.0 * (robot.max_brake_mps2 or robot.max_accel_mps2))
    half = 0.5 * float(times[1] - times[0])
    found = []
    for i in range(len(moving)):
        alone = moving.alone(i)
        gaps = alone.distance(places, times) - radius
        k = int(gaps.argmin())
        least = max(proven, float(gaps[k]) - half * (float(speeds.max()) + alone.top_speed))
        if least > 0.0 and gaps[k] <= near:
            speed = _speed_told(float(speeds[k]))
            found.append(Pass(float(times[k]), moving.name(i), least, speed))
    return tuple(sorted(found, key=lambda one: one.time))


def _speed_told(speed: float) -> float:
    """The speed of a robot [m/s]; 0 if it stands."""
    return speed if speed > STANDING_MPS else 0.0
