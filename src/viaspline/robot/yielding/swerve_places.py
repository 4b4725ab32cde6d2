"""Places beside its path by which a robot may get out of the way of what moves.

They are chosen by a rough drive to each, sampled; the path that is laid through the best of them
is timed and looked at as any other.

Tested through ``robot/yielding/test_give_way``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.robot.replanning.replan_context import ReplanContext

AHEAD_S = (1.0, 2.0, 3.5)
"""Places lie as far away as the robot comes in these times at its top speed [s],"""

BEARINGS_DEG = (-90.0, -60.0, -35.0, -15.0, 15.0, 35.0, 60.0, 90.0)
"""and in these directions from where it heads [deg]; they are farther off to the sides than what
moves is wide."""

LOOKED_S, SAMPLE_S = 3.0, 0.3
"""The rough drive is looked at for so long, and so often [s]."""

SHARES = (0.4, 1.0)
"""Of its top speed, at which the robot may go there."""

AMPLE_M = 1.0
"""More room than this is no better [m]."""

LATE_PRICE = 0.1
"""What a metre of progress that is lost counts in metres of room."""


def swerve_places(context: ReplanContext, most: int) -> Floats:
    """Places through which a path may lead past what moves, the most promising first [m], (k, 2).

    Args:
        context: The robot under way.
        most: So many at most.
    """
    path, limits, speed = context.schedule.path, context.task.limits, context.speed
    leave = context.stop if speed == 0.0 else context.leaves[0]
    u = float(path.parameter(leave))
    here, heading = np.asarray(path.evaluate(u)), float(path.heading(u))
    goal = np.array(context.vias_ahead[0][0].at)
    around = np.radians(BEARINGS_DEG) + heading
    if speed == 0.0:
        around = np.append(around, (heading + math.pi, heading))
    rays = np.column_stack((np.cos(around), np.sin(around)))
    far = np.array(AHEAD_S) * limits.max_speed * 0.75
    places = (here + far[:, None, None] * rays).reshape(-1, 2)
    world, required = context.knowledge.world, context.requirements.required
    free: Floats = places[world.distance(places) >= required]
    if not len(free):
        return free
    rank = _scores(context, here, free, goal)
    return free[np.argsort(-rank, kind="stable")[:most]]


def _scores(context: ReplanContext, here: Floats, places: Floats, goal: Floats) -> Floats:
    """How good it is to go by each place: the room there is, less the way that is lost."""
    times = np.arange(SAMPLE_S, LOOKED_S, SAMPLE_S)
    out = np.hypot(*(places - here).T)
    onward = goal - places
    back = np.maximum(np.hypot(*onward.T), 1e-9)
    along = np.concatenate([_along(context, share, times) for share in SHARES])
    first = np.minimum(along / out[:, None], 1.0)[..., None]
    then = np.clip((along - out[:, None]) / back[:, None], 0.0, 1.0)[..., None]
    spots = here + first * (places - here)[:, None] + then * onward[:, None]
    moments = context.progress.time + np.tile(times, len(SHARES) * len(places))
    gaps = context.knowledge.moving.distance(spots.reshape(-1, 2), moments)
    gaps = gaps.reshape(len(places), len(SHARES), len(times)) - context.requirements.around
    least = np.minimum(gaps.min(axis=2), AMPLE_M)
    touched = times[(gaps < 0.0).argmax(axis=2)]
    least = np.where(least < 0.0, AMPLE_M * (touched / LOOKED_S - 2.0), least)
    ends = spots.reshape(len(places), len(SHARES), len(times), 2)[:, :, -1]
    left = np.hypot(*np.moveaxis(goal - ends, -1, 0))
    scores: Floats = (least - LATE_PRICE * left).max(axis=1)
    return scores


def _along(context: ReplanContext, share: float, times: Floats) -> Floats:
    """How far a robot comes that goes over to a share of its top speed [m]."""
    limits, speed = context.task.limits, context.speed
    cruise = share * limits.max_speed
    rate = limits.max_accel if cruise > speed else -limits.brake
    early = np.minimum(times, (cruise - speed) / rate)
    far: Floats = speed * early + 0.5 * rate * early**2 + cruise * (times - early)
    return far
