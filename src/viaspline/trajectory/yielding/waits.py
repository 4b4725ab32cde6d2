"""Where a law waits or slows for what moves, for how long, and for what."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.trajectory.trajectory import Trajectory
from viaspline.trajectory.yielding.law_knots import LawKnots
from viaspline.trajectory.yielding.road import Road
from viaspline.trajectory.yielding.traffic import Traffic
from viaspline.world.moving_obstacles import MovingObstacles

LEAST_S = 0.05
"""Less than that isn't told [s]."""
APART_M = 0.5
"""Two waits with so much road between them are two [m]."""
PLACES = 400
"""Laws are compared at so many places along them, and where they change."""


@dataclass(frozen=True)
class TrafficWait:
    """A stretch on which a law loses time to what moves.

    Attributes:
        start: Distance along the path where it begins to [m].
        end: Where it has [m].
        begins: When the robot is at the start of it [s].
        lost: How much later it is at its end than the fastest law would be [s].
        stood: For how long of it the robot stands, beyond what stations ask [s].
        obstacle: The name of what comes first that the fastest law would meet there.
    """

    start: float
    end: float
    begins: float
    lost: float
    stood: float
    obstacle: str


def waits(
    path: PiecewiseCubic,
    trajectory: Trajectory,
    static: Trajectory,
    *,
    moving: MovingObstacles,
    required: float,
    hold: float = 0.0,
) -> tuple[TrafficWait, ...]:
    """Where a law waits or slows, compared with the fastest one where nothing moves.

    Args:
        path: What is driven.
        trajectory: The law, of ``law_among``.
        static: The law of ``retime`` for the same.
        moving: As for ``law_among``.
        required: As for ``law_among`` [m].
        hold: As for ``law_among`` [s].

    Returns:
        In the order of the drive; nothing where the laws are one.

    Example:
        >>> from viaspline.curve.path import Path
        >>> from viaspline.mission.shapes.obstacle import Obstacle
        >>> from viaspline.trajectory.limits import Limits
        >>> from viaspline.trajectory.retime import retime
        >>> from viaspline.trajectory.yielding.law_among import law_among
        >>> line = Path([[[0, 0], [10, 0], [20, 0], [30, 0]]], vias=[])
        >>> cart = Obstacle(
        ...     name="cart",
        ...     circle={"center": (0, 0), "radius": 1},
        ...     motion={"from": (15, -8), "velocity_mps": (0, 1)},
        ... )
        >>> moving, limits = MovingObstacles([cart]), Limits(max_speed=2, max_accel=1)
        >>> law = law_among(line, limits, moving=moving, required=0.5).value
        >>> found = waits(line, law, retime(line, limits), moving=moving, required=0.5)
        >>> [(round(wait.lost, 1), wait.obstacle) for wait in found]
        [(1.2, 'cart')]
    """
    road, traffic = Road.of(path), Traffic(moving, required, hold)
    places, delays = _delays(trajectory, static)
    found = []
    for first, last in _rises(places, delays):
        start, end = float(places[first]), float(places[last])
        lost = float(delays[last] - delays[first])
        rest = _from(static, start)
        late = LawKnots(rest.times + float(delays[first]), rest.places, rest.speeds)
        index = traffic.met(road, late)
        begins = float(late.times[0])
        found.append(
            TrafficWait(
                start, end, begins, lost,
                _stood(trajectory, start, end) - _stood(static, start, end), moving.name(index),
            )
        )  # fmt: skip
    return tuple(found)


def _delays(law: Trajectory, static: Trajectory) -> tuple[Floats, Floats]:
    """How much later a law is than another, place by place; twice where one stands."""
    even = np.linspace(law.distances[0], law.distances[-1], PLACES)
    places = np.unique(np.concatenate((law.distances, static.distances, even)))
    came = law.time_at(places) - static.time_at(places)
    left = _left(law, places) - _left(static, places)
    return np.repeat(places, 2), np.column_stack((came, left)).ravel()


def _left(law: Trajectory, places: Floats) -> Floats:
    """When a law leaves places [s]."""
    last = law.distances.searchsorted(places, side="right") - 1
    return np.where(law.distances[last] == places, law.times[last], law.time_at(places))


def _rises(places: Floats, delays: Floats) -> Iterator[tuple[int, int]]:
    """From where to where a delay grows, with no long way between on which it doesn't."""
    first = last = 0
    for i, (before, now) in enumerate(pairwise(delays.tolist()), start=1):
        if now > before + 1e-9:
            if last > first and places[i - 1] - places[last] > APART_M:
                if delays[last] - delays[first] > LEAST_S:
                    yield first, last
                first = i - 1
            elif last == first:
                first = i - 1
            last = i
    if delays[last] - delays[first] > LEAST_S:
        yield first, last


def _stood(law: Trajectory, start: float, end: float) -> float:
    """For how long a law stands from one place to another [s]."""
    stands = (np.diff(law.distances) == 0.0) & (law.speeds[:-1] == 0.0)
    there = (law.distances[:-1] >= start) & (law.distances[:-1] <= end)
    return float(np.diff(law.times)[stands & there].sum())


def _from(law: Trajectory, place: float) -> LawKnots:
    """A law without changes of its acceleration, from a place on."""
    after = int(law.distances.searchsorted(place, side="right"))
    begin = np.array([float(_left(law, np.array([place]))[0])])
    speed = np.array([float(law.speed_at(place))])
    rest = LawKnots(law.times[after:], law.distances[after:], law.speeds[after:])
    return LawKnots(begin, np.array([place]), speed).followed_by(rest)
