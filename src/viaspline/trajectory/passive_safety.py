"""Passive safety: laws along a path by which a robot is at rest before anything touches it."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from viaspline.curve.path import Path
from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.kernels.motion import passive_stop as kernels
from viaspline.kernels.motion.passive_contacts import LEAST_GAP
from viaspline.trajectory.passive_premises import (
    SAME_PLACE_M,
    SPACING_M,
    ChordTable,
    PassivePremises,
)
from viaspline.trajectory.retime import braking
from viaspline.trajectory.trajectory import Trajectory

FIRST_STEPS_M: Final = (0.001, 0.003, 0.006, 0.012, 0.025, 0.05)
"""Places of a law, from where the robot is, that lie closer together: one that stands near to what
might come goes no farther than that in the time in which it can still stand again [m]."""


def proven_until(path: Path, law: Trajectory, premises: PassivePremises, keep: float) -> float:
    """Up to when it is proven that nothing touches the robot while it moves by a law [s].

    What touches it while it stands isn't asked.

    Args:
        path: What is driven.
        law: When it is where, from the look on.
        premises: What may come.
        keep: The body's radius and how far beside its path it may be [m].

    Returns:
        Infinite if all of the law is proven.

    Raises:
        GeometryError: When the law limits the jerk, or begins before the look.

    Example:
        >>> from viaspline.world.moving_obstacles import MovingObstacles
        >>> path, nothing = Path([[(x, 0.0) for x in (0, 3, 6, 9)]], []), MovingObstacles()
        >>> law = braking(0.0, speed=2.0, max_accel=1.0, start_time=0.0)
        >>> looks = [PassivePremises(nothing, 0.0, 1.0, (0, 0), reach) for reach in (4.51, 4.0)]
        >>> [round(proven_until(path, law, look, 0.5), 1) for look in looks]
        [inf, 1.6]
    """
    pieces = _pieces(law)
    _check_begin(float(law.times[0]), premises)
    part = ChordTable.of(path, float(law.distances[0]), float(law.distances[-1]))
    pieces[:, 0] -= part.origin
    kept = keep + part.sag
    threats = premises.along(part, kept)
    return float(kernels.first_contact(threats, part.places, SPACING_M, kept, pieces))


def at_rest_until(
    path: Path, distance: float, begin: float, stay: float, premises: PassivePremises, keep: float
) -> float:
    """Up to when it is proven that nothing on the map touches a robot which stands [s].

    Args:
        path: On which it stands.
        distance: Where, along it [m].
        begin: From when on [s].
        stay: For how long [s].
        premises: What may come.
        keep: The body's radius and how far beside its path it may be [m].

    Returns:
        Infinite if it is for as long as it stays.

    Raises:
        GeometryError: When it begins before the look.

    Example:
        >>> from viaspline.mission.shapes.obstacle import Obstacle
        >>> from viaspline.world.moving_obstacles import MovingObstacles
        >>> path = Path([[(x, 0.0) for x in (0, 3, 6, 9)]], [])
        >>> motion = {"from": (4, 5), "velocity_mps": (0, -1)}
        >>> cart = Obstacle(circle={"center": (0, 0), "radius": 0.5}, motion=motion)
        >>> known = MovingObstacles([cart])
        >>> look = PassivePremises(MovingObstacles(), 0.0, 1.0, (0, 0), charted=known)
        >>> round(at_rest_until(path, 4.0, 1.0, 8.0, look, 0.5), 2)
        4.0
        >>> at_rest_until(path, 2.0, 1.0, 8.0, look, 0.5)
        inf
    """
    return _touched_at_rest(path, distance, begin, stay, premises, keep, premises.first_charted)


def touched_from(
    path: Path, distance: float, begin: float, stay: float, premises: PassivePremises, keep: float
) -> float:
    """From when on it isn't proven that nothing at all touches a robot which stands [s].

    Args, returns and raises as ``at_rest_until``, which knows of what is on the map alone.

    Example:
        >>> from viaspline.world.moving_obstacles import MovingObstacles
        >>> path = Path([[(x, 0.0) for x in (0, 3, 6, 9)]], [])
        >>> look = PassivePremises(MovingObstacles(), 0.0, 1.0, (0, 0), 6.0)
        >>> round(touched_from(path, 4.0, 0.0, 8.0, look, 0.5), 2)
        1.5
    """
    return _touched_at_rest(path, distance, begin, stay, premises, keep, 0)


def _touched_at_rest(
    path: Path, distance: float, begin: float, stay: float, premises: PassivePremises, keep: float,
    first: int,
) -> float:  # fmt: skip
    """From when on a robot that stands may be touched by the sources from ``first`` on [s]."""
    _check_begin(begin, premises)
    part = ChordTable.at(path, distance)
    threats, places = premises.along(part, keep), part.places
    touched = kernels.touched_at_rest(threats, first, places, SPACING_M, keep, 0.0, begin, stay)
    return float(touched)


def passive_law(
    path: Path,
    upper: Trajectory,
    premises: PassivePremises,
    keep: float,
    limits: tuple[float, float],
    now: float,
    lasting: float = math.inf,
    stay: float = 0.0,
    settle: float = 0.0,
) -> tuple[Trajectory, bool]:
    """A law no faster than another, from all places of which the robot stops in time.

    It begins where the other one is now, and goes as far as that one's next rest, or to a rest
    before.

    Args:
        path: What is driven.
        upper: The law that it may drive by where nothing can come: within all of its limits.
        premises: What may come.
        keep: The body's radius and how far beside its path it may be [m].
        limits: Largest acceleration and deceleration along the path [m/s²].
        now: When it begins, by the clock of ``upper`` [s].
        lasting: So long it goes on if it may; then it brakes [s]. Who looks again before then need
            not know more.
        stay: Where it stops what is on the map has to stay away for so long [s].
        settle: For so long after its law rests the robot may still move, and nothing may come [s].

    Returns:
        (the law, whether it is proven). Not proven: not even braking at once is, and that is the
        law.

    Raises:
        GeometryError: When the law limits the jerk, or begins before the look.

    Example:
        >>> from viaspline.trajectory.limits import Limits
        >>> from viaspline.trajectory.retime import retime
        >>> from viaspline.world.moving_obstacles import MovingObstacles
        >>> path = Path([[(x, 0.0) for x in (0, 3, 6, 9)]], [])
        >>> free = retime(path, Limits(max_speed=2.0, max_accel=1.0))
        >>> blind = PassivePremises(MovingObstacles(), 0.0, 0.5, (0, 0), 6.0)
        >>> law, proven = passive_law(path, free, blind, 0.5, (1.0, 1.0), 0.0)
        >>> bool(proven), float(law.speeds.max().round(2)), float(law.distances[-1].round(1))
        (True, 1.9, 3.6)
    """
    accel, brake = limits
    if upper.changes is not None:
        raise GeometryError("passive safety is proven for laws without a limit of the jerk alone")
    _check_begin(now, premises)
    here, speed, _ = (float(value) for value in upper.state_at(now))
    end = upper.next_rest(here) if speed > 0.0 else upper.next_rest(here + SAME_PLACE_M)
    line = _line(upper, here, end)
    caps = np.interp(line, upper.distances, upper.speeds**2)
    caps[0] = speed**2
    part = ChordTable.of(path, here, end)
    kept = keep + part.sag + 2.0 * LEAST_GAP  # so that a check finds it proven, too
    distances, squares, proven = kernels.passive_profile(
        premises.along(part, kept), part.places, SPACING_M, kept, accel, brake,
        line - part.origin, caps, speed, now, lasting, stay, settle,
    )  # fmt: skip
    if distances.size == 1:
        distances, squares = np.append(distances, distances), np.zeros(2)
    law = Trajectory.through(part.origin + distances, squares, max_accel=brake, start_time=now)
    return law, bool(proven)


def stop_of(law: Trajectory, now: float, brake: float) -> Trajectory:
    """How a robot stops that has driven by a proven law up to now.

    It goes on to the law's next place and brakes from there: that was proven with the law, whatever
    later looks show.

    Args:
        law: By ``passive_law``, proven.
        now: Not before the law begins [s].
        brake: That the law was proven with [m/s²].

    Example:
        >>> law = Trajectory.through(
        ...     np.array((0.0, 3.0, 4.0)), np.array((4.0, 1.0, 0.0)), max_accel=0.5
        ... )
        >>> stop_of(law, 1.0, brake=1.0).distances
        array([1.75, 3.  , 3.5 ])
    """
    here, speed, _ = (float(value) for value in law.state_at(now))
    following = int(law.times.searchsorted(now, side="left"))
    if speed <= 0.0 or following >= law.times.size:
        return braking(here, 0.0, brake, now)
    place, square = float(law.distances[following]), float(law.speeds[following]) ** 2
    distances = np.array((here, place, place + square / (2.0 * brake)))
    squares = np.array((speed**2, square, 0.0))
    apart = np.append(True, np.diff(distances) > 0.0)
    return Trajectory.through(distances[apart], squares[apart], max_accel=brake, start_time=now)


def stoppable_speeds(
    path: Path,
    distances: ArrayLike,
    times: ArrayLike,
    caps: ArrayLike,
    premises: PassivePremises,
    keep: float,
    brake: float,
) -> Floats:
    """The largest speed at places along a path from which the robot stops in time [m/s], (m,).

    Args:
        path: What is driven.
        distances: Along it [m], (m,), not decreasing.
        times: When the robot is there [s], (m,), not before the look.
        caps: No larger speed is looked for [m/s], (m,).
        premises: What may come.
        keep: The body's radius and how far beside its path it may be [m].
        brake: Deceleration [m/s²].

    Raises:
        GeometryError: When a time is before the look.

    Example:
        >>> from viaspline.world.moving_obstacles import MovingObstacles
        >>> path = Path([[(x, 0.0) for x in (0, 3, 6, 9)]], [])
        >>> blind = PassivePremises(MovingObstacles(), 0.0, 1.0, (0, 0), 4.0)
        >>> stoppable_speeds(path, [0, 2], [0, 0], [9, 9], blind, 0.5, 1.0).round(2)
        array([1.83, 1.  ])
    """
    along = np.asarray(distances, np.float64)
    instants = np.ascontiguousarray(np.broadcast_to(np.asarray(times, np.float64), along.shape))
    highest = np.ascontiguousarray(np.broadcast_to(np.asarray(caps, np.float64), along.shape))
    if not along.size:
        return np.empty(0)
    _check_begin(float(instants.min()), premises)
    part = ChordTable.of(path, float(along[0]), float((along + highest**2 / (2.0 * brake)).max()))
    kept = keep + part.sag
    speeds: Floats = kernels.stoppable_speeds(
        premises.along(part, kept), part.places, SPACING_M, kept, brake,
        along - part.origin, instants, highest,
    )  # fmt: skip
    return speeds


def _check_begin(time: float, premises: PassivePremises) -> None:
    if time < premises.seen_at:
        raise GeometryError(
            f"a law from {time:g} s on can't be proven by a look of {premises.seen_at:g} s; give "
            "the look before it"
        )


def _pieces(law: Trajectory) -> Floats:
    """The pieces of a law as kernels take them, (p, 5)."""
    if law.changes is not None:
        raise GeometryError("passive safety is proven for laws without a limit of the jerk alone")
    return np.column_stack(
        (law.distances[:-1], law.speeds[:-1], law.accelerations, law.times[:-1], np.diff(law.times))
    )


def _line(upper: Trajectory, here: float, end: float) -> Floats:
    """Places of a law between two distances: its own, and others where these are far apart.

    A step is proven as a whole, so short ones begin it: from rest, 0.1 m and the stop after it take
    0.9 s by 1 m/s², in which nothing may come.
    """
    inside = upper.distances[(upper.distances > here) & (upper.distances < end)]
    count = max(math.ceil((end - here) / SPACING_M), 1)
    first = here + np.array(FIRST_STEPS_M)
    marks = np.union1d(np.linspace(here, end, count + 1), inside)
    marks = np.union1d(marks, first[first < end])
    kept = np.append(np.diff(marks) > SAME_PLACE_M, True)
    line: Floats = marks[kept]
    line[0] = here
    return line
