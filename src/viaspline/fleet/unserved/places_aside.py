"""A place beside a path for a robot that rests on it, no farther away than it has to be.

Tested through ``fleet/test_unserved_fleets``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.fleet.laying.lay_among_rests import KEPT_MORE_M
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.planning.problem.requirements import Requirements

LOOKS = 64
"""Places on a span that are looked at for the nearest one."""
ROUNDED_M = 0.1
"""To what the place is rounded [m]."""


def place_aside(
    timed: TimedFleet, passes: int, rests: int, place: tuple[float, float]
) -> tuple[float, float] | None:
    """Where a robot could rest so that the path of another one doesn't pass there.

    Args:
        timed: The fleet.
        passes: The robot whose path it is.
        rests: The robot that rests.
        place: Where it does [m].

    Returns:
        The nearer of the two places beside the path that are free; None if neither is.
    """
    plan, resting = timed.ways.plans[passes], timed.ways.plans[rests]
    reach = timed.ways.courses.packed.reach
    path = plan.path
    u = np.linspace(*path.domain, LOOKS * len(path.spans) + 1)
    apart = np.hypot(*(np.asarray(path.evaluate(u))[:, :2] - place).T)
    nearest = float(u[int(apart.argmin())])
    x, y = np.asarray(path.evaluate(nearest))[:2].tolist()
    heading = float(path.heading(nearest))
    far = float(reach[passes] + reach[rests]) + KEPT_MORE_M + ROUNDED_M
    kept = Requirements.of(resting.mission, resting.tracking_error).around
    places = [
        (
            round((x - side * far * math.sin(heading)) / ROUNDED_M) * ROUNDED_M,
            round((y + side * far * math.cos(heading)) / ROUNDED_M) * ROUNDED_M,
        )
        for side in (1.0, -1.0)
    ]
    free = [(round(a, 6), round(b, 6)) for a, b in places if resting.world.distance((a, b)) >= kept]
    return min(free, key=lambda one: math.dist(one, place), default=None)
