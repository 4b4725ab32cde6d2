"""Where a robot stands for long on a drive, and when nothing that moves can matter there.

So long nothing changes: the drive is stepped over, and few moments of it are kept.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.mission.robot_parts import RobotSpec
from viaspline.robot.simulation.body_among_movers import movers_about
from viaspline.robot.simulation.driven_motion import DrivenMotion
from viaspline.robot.simulation.near_times import Gaps, near_times
from viaspline.tracks.encounters import Movers
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles

LONG_S = 60.0
"""What is shorter is looked at as all else [s],"""

EDGE_S = 20.0
"""and so is what is so near to its ends, or to when something is near [s]."""

Laws = Sequence[tuple[float, Trajectory]]
"""Time laws and when each took over [s]."""


@dataclass(frozen=True)
class LongStay:
    """A robot stands, for long or until it is known for how long.

    Attributes:
        begin: Since when [s].
        end: Until when [s].
        distance: Where, along what is driven [m].
    """

    begin: float
    end: float
    distance: float

    @property
    def seconds(self) -> float:
        """For how long [s]."""
        return self.end - self.begin

    def calm(self, near: Iterable[tuple[float, float]]) -> tuple[tuple[float, float], ...]:
        """When nothing is near for long, in order.

        >>> LongStay(0.0, 1000.0, 5.0).calm([(300.0, 310.0), (320.0, 350.0)])
        ((20.0, 280.0), (370.0, 980.0))
        """
        free, since = [], self.begin
        for begin, end in (*sorted(near), (self.end, self.end)):
            if begin - since > LONG_S + 2.0 * EDGE_S:
                free.append((since + EDGE_S, begin - EDGE_S))
            since = max(since, end)
        return tuple(free)


def standstill_at(law: Trajectory, time: float) -> LongStay | None:
    """Where and how long a time law stands at a time [s]; None: it doesn't, or is over."""
    if not time < law.end_time:
        return None
    distance = law.distances[max(int(law.times.searchsorted(time, side="right")) - 1, 0)]
    first = int(law.distances.searchsorted(distance, side="left"))
    after = int(law.distances.searchsorted(distance, side="right"))
    begin = -math.inf if first == 0 else float(law.times[first])
    end = float(law.times[after - 1])
    return LongStay(begin, end, float(distance)) if begin <= time < end else None


def standstills(laws: Laws, end: float) -> tuple[LongStay, ...]:
    """Where a robot stood for long, in order.

    Args:
        laws: What it drove by; each holds until the next one.
        end: When its drive was over [s].
    """
    if not laws:
        return ()
    found: list[LongStay] = []
    untils = [*(begin for begin, _ in laws[1:]), end]
    for (begin, law), until in zip(laws, untils, strict=True):
        edges = np.concatenate(([-math.inf], law.times, [math.inf])).clip(begin, until)
        places = np.concatenate((law.distances[:1], law.distances, law.distances[-1:]))
        stands = (np.diff(places) == 0.0) & (np.diff(edges) > 0.0)
        for k in np.flatnonzero(stands).tolist():
            one = LongStay(float(edges[k]), float(edges[k + 1]), float(places[k]))
            if found and found[-1].end == one.begin and found[-1].distance == one.distance:
                one = LongStay(found.pop().begin, one.end, one.distance)
            found.append(one)
    return tuple(one for one in found if one.seconds > LONG_S)


def calm_at(
    standstill: LongStay,
    robot: RobotSpec,
    moving: MovingObstacles,
    place: Floats,
    heading: float,
) -> tuple[tuple[float, float], ...]:
    """When nothing that moves touches a robot that stands, nor comes nearer than at other times.

    Args:
        standstill: When it stands.
        robot: Its body.
        moving: All that moves.
        place: Where it stands [m], (2,).
        heading: How it is turned [rad].
    """
    ends, twice = np.array([standstill.begin, standstill.end]), np.zeros(2)
    places = np.tile(place[:2], (2, 1))
    motion = DrivenMotion(ends, places, twice + heading, twice, twice, 1.0)
    radius, movers = movers_about(robot, moving, motion)
    near: list[tuple[float, float]] = []
    for i in range(len(moving)):
        gaps = _gaps(movers.alone(i), place, radius)
        near += near_times(moving, i, gaps, standstill.begin, standstill.end)
    return standstill.calm(near)


def unseen_at(
    standstill: LongStay, moving: MovingObstacles, place: Floats, reach: float
) -> tuple[tuple[float, float], ...]:
    """When a robot that stands has nothing that moves in sight, or what has long come to rest.

    Args:
        standstill: When it stands.
        moving: What it could see.
        place: Where it stands [m], (2,).
        reach: How far it sees [m].
    """
    near: list[tuple[float, float]] = []
    for i in range(len(moving)):
        gaps = _gaps(moving.alone(i), place, 0.0)
        near += near_times(moving, i, gaps, standstill.begin, standstill.end, reach)
    return standstill.calm(near)


def _gaps(movers: Movers, place: Floats, radius: float) -> Gaps:
    """The distances of what moves from a place [m], (2,), less a radius [m], as of times."""

    def gaps(times: Floats) -> Floats:
        return movers.distance(np.tile(place[:2], (len(times), 1)), times) - radius

    return gaps
