"""Proofs that no path and no law is clear of what moves, from what holds of all of them.

From rest a robot gets no farther in a time than its limits allow. So where something that moves is
nearer to the start than may be by more than that, nothing that the robot does helps. For the
points of the route see ``taken_points``.

Tested through ``spacetime/test_plan_among``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.errors import Change, NoPathError
from viaspline.kernels.arrays import Floats
from viaspline.spacetime.timed_problem import TimedProblem

STEP_S = 0.02  # between instants that are looked at
LOOKED_AHEAD_S = 120.0
ROUNDING_M = 1e-6


def check_start(problem: TimedProblem) -> None:
    """Refuse a start that is run over, whatever the robot does.

    Raises:
        NoPathError: With what runs it over, and when setting out would be all right.
    """
    route = problem.mission.route
    caught = _caught(problem, route.depart_s)
    if caught is None:
        return
    time, name = caught
    later = next(
        (
            t
            for t in np.arange(route.depart_s + 1.0, route.depart_s + LOOKED_AHEAD_S, 1.0).tolist()
            if _caught(problem, t) is None
        ),
        None,
    )
    remedy = "move the start, or take the obstacle out of its way"
    changes: tuple[Change, ...] = ()
    if later is not None:
        remedy = f"depart {later - route.depart_s:g} s later (route.depart_s: {later:g})"
        changes = (Change("route.depart_s", later),)
    raise NoPathError(
        f"'{name}' runs over the start at {time:.2f} s, before the robot can get out of its way",
        where=route.start.at,
        remedy=remedy,
        obstacles=(name,),
        changes=changes,
    )


def _caught(problem: TimedProblem, depart: float) -> tuple[float, str] | None:
    """When a robot that sets out at a time is caught, wherever it goes, and by what."""
    limits = problem.limits
    accel = max(limits.max_accel, limits.brake)
    escapes = max(limits.max_speed / accel, math.sqrt(2.0 * problem.required / accel))
    late = np.arange(0.0, escapes + problem.required / limits.max_speed + STEP_S, STEP_S)
    reach = _reach(late, accel, limits.max_speed)
    start = np.tile(np.asarray(problem.mission.route.start.at[:2], float), (len(late), 1))
    gaps, nearest = problem.moving.nearest(start, depart + late)
    caught = np.flatnonzero(gaps + reach < problem.least - ROUNDING_M)
    if not caught.size:
        return None
    k = int(caught[0])
    return depart + float(late[k]), problem.moving.name(int(nearest[k]))


def _reach(late: Floats, accel: float, top: float) -> Floats:
    """How far a robot gets from rest in a time [m]."""
    speeding = np.minimum(late, top / accel)
    reach: Floats = 0.5 * accel * speeding**2 + top * (late - speeding)
    return reach
