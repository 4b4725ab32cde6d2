"""Where on the path that is flown another one may begin.

Tested through ``space/online/test_fly``.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np

from viaspline.space.online.flown_leg import FlownLeg

LATENCY_S: Final = 0.2
"""Between what is seen and what is done about it."""

CHOICES: Final = 24


class Takeover(NamedTuple):
    """A place of the path from which on another one is flown.

    Attributes:
        time: When it is reached [s].
        distance: Along the old path [m].
        speed: There [m/s]; 0 where the robot stops first.
        since: When it begins to brake for it [s]; else the same as ``time``.
    """

    time: float
    distance: float
    speed: float
    since: float


def smooth_takeover(leg: FlownLeg, now: float, brake: float) -> Takeover:
    """The place within reach of a stop at which the old path bends least.

    A new path begins straight, so there its curvature hardly jumps.

    Args:
        leg: What is flown.
        now: [s].
        brake: Largest deceleration [m/s²].
    """
    first = min(now + LATENCY_S, leg.law.end_time)
    _, speed, _ = (float(value) for value in leg.law.state_at(first))
    times = np.linspace(first, min(first + 0.5 * speed / brake, leg.law.end_time), CHOICES)
    distances, speeds, _ = leg.law.state_at(times)
    distances = np.clip(distances, 0.0, leg.path.length)
    bends = leg.path.curvature(np.asarray(leg.path.parameter(distances)))
    best = int(np.argmin(np.round(bends, 4)))
    time = float(times[best])
    return Takeover(time, float(distances[best]), float(speeds[best]), time)


def braked_takeover(leg: FlownLeg, now: float, brake: float, share: float) -> Takeover:
    """Where it is when it has braked as hard as it can, to a share of its speed; 0: it stops.

    Args:
        leg: What is flown.
        now: [s].
        brake: Largest deceleration [m/s²].
        share: Of the speed, from 0 to below 1.
    """
    first = leg.law.cut_after(min(now + LATENCY_S, leg.law.end_time))
    distance, speed, _ = (float(value) for value in leg.law.state_at(first))
    left = share * speed
    place = min(distance + (speed * speed - left * left) / (2.0 * brake), leg.path.length)
    return Takeover(first + (speed - left) / brake, place, left, first)
