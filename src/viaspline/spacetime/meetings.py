"""Where and when a law comes too close to what moves; sampled: for choosing, not for proving.

Tested through ``spacetime/test_plan_among``.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from viaspline.curve.path import Path
from viaspline.kernels.arrays import Floats
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles

SAMPLE_S = 0.1
MAX_SAMPLES = 20_000
MAX_PLACES = 500  # of a path
INSTANTS = 120


class Meeting(NamedTuple):
    """An obstacle that is too close for a while.

    Attributes:
        obstacle: Its index.
        begins: When [s].
        ends: When [s].
        distance: Where the robot is along its path when it begins [m].
    """

    obstacle: int
    begins: float
    ends: float
    distance: float

    @property
    def windows(self) -> tuple[tuple[float, float], ...]:
        """For which whiles it may be taken to stand where it is, for a path round it [s]."""
        middle = 0.5 * (self.begins + self.ends)
        return ((middle, middle), (self.begins, self.ends))


def first_meeting(
    path: Path,
    law: Trajectory,
    moving: MovingObstacles,
    required: float,
    span: tuple[float, float] | None = None,
) -> Meeting | None:
    """The first time that a law comes too close to what moves, as far as samples tell.

    Args:
        path: What is driven.
        law: When.
        moving: What moves.
        required: Distance that is to be kept [m].
        span: From when to when it is looked at [s]; after its law the robot stands. None: as long
            as the law lasts.
    """
    begin, end = (law.start_time, law.end_time) if span is None else span
    count = min(max(int((end - begin) / SAMPLE_S), 2), MAX_SAMPLES)
    times = np.linspace(begin, end, count + 1)
    along = np.minimum(np.asarray(law.distance_at(times)), path.length)  # but for rounding
    gaps, nearest = moving.nearest(np.asarray(path.at_distance(along)), times)
    close = np.flatnonzero(gaps < required)
    if not close.size:
        return None
    first = int(close[0])
    obstacle = int(nearest[first])
    last = first
    while last + 1 <= count and gaps[last + 1] < required and nearest[last + 1] == obstacle:
        last += 1
    return Meeting(obstacle, float(times[first]), float(times[last]), float(along[first]))


def times_near(
    path: Path,
    moving: MovingObstacles,
    obstacle: int,
    required: float,
    span: tuple[float, float],
) -> Floats:
    """Instants at which an obstacle is too close to some place of a path [s], as samples tell.

    Args:
        path: What is to be driven.
        moving: What moves.
        obstacle: Which of it.
        required: Distance that is to be kept [m].
        span: From when to when it is looked at [s].
    """
    alone = moving.alone(obstacle)
    count = int(np.clip(path.length / max(required, 1e-3), 16, MAX_PLACES))
    places = np.asarray(path.at_distance(np.linspace(0.0, path.length, count)))[:, :2]
    times = np.linspace(*span, INSTANTS)
    gaps = np.array([alone.distance(places, time).min() for time in times])
    near: Floats = times[gaps < required]
    return near
