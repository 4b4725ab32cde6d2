"""How near a driven robot came to what moves, and what touched it.

Tested through ``robot/simulation/test_encounters``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.mission.robot_parts import RobotSpec
from viaspline.robot.run import Contact, Encounters
from viaspline.world.moving_obstacles import MovingObstacles

RESOLUTION_S = 1e-3
"""Between two instants that are looked at."""

AT_ONCE = 50_000
"""Instants that are looked at together."""

STANDING_MPS = 1e-3
"""A robot that is slower stands [m/s]."""


@dataclass(frozen=True)
class DrivenStates:
    """Where a robot was at every time.

    Attributes:
        begin: When it set off [s].
        end: When it arrived, or was stopped [s].
        state_at: Its places [m], (n, 2), and its speeds [m/s], (n,), at times [s], (n,).
    """

    begin: float
    end: float
    state_at: Callable[[Floats], tuple[Floats, Floats]]


def encounters(motion: DrivenStates, robot: RobotSpec, moving: MovingObstacles) -> Encounters:
    """How near a drive came to what moves.

    The distance changes by no more than both can go in the time between two instants, so what is
    measured there, less that, is proven for all of the drive; what jumps, where a motion begins
    again, counts from when it is there. A body that is no disc is taken for the one around it.

    Args:
        motion: Where the robot was when.
        robot: Its body.
        moving: All that moved, known or not.
    """
    if not len(moving):
        return Encounters(math.inf, None, None, ())
    count = max(math.ceil((motion.end - motion.begin) / RESOLUTION_S), 1)
    times = np.linspace(motion.begin, motion.end, count + 1)
    step = float(times[1] - times[0])
    gaps, nearest, speeds = np.empty(count + 1), np.empty(count + 1, np.int64), np.empty(count + 1)
    for first in range(0, count + 1, AT_ONCE):
        part = slice(first, first + AT_ONCE)
        places, speeds[part] = motion.state_at(times[part])
        gaps[part], nearest[part] = moving.nearest(places, times[part])
    gaps -= robot.outer_radius
    k = int(gaps.argmin())
    if nearest[k] < 0:
        return Encounters(math.inf, None, None, ())
    apart = 0.5 * step * (float(speeds.max()) + moving.top_speed)
    contacts = _contacts(times, gaps, nearest, speeds, moving)
    return Encounters(
        float(gaps[k]) - apart, float(times[k]), moving.name(int(nearest[k])), contacts
    )


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
    times: Floats, gaps: Floats, nearest: Ints, speeds: Floats, moving: MovingObstacles
) -> tuple[Contact, ...]:
    """Each touch, from its beginning, with how fast the robot was."""
    touching = gaps < 0.0
    begins = np.flatnonzero(touching & ~np.concatenate(([False], touching[:-1])))
    found = []
    for k in begins.tolist():
        speed = float(speeds[k]) if speeds[k] > STANDING_MPS else 0.0
        found.append(Contact(float(times[k]), moving.name(int(nearest[k])), speed))
    return tuple(found)
