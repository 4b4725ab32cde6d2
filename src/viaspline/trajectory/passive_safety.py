"""Passive safety: laws along a path by which a robot is at rest before anything touches it."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from viaspline.curve.path import Path
from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.kernels.motion import passive_stop as kernels
from viaspline.kernels.motion.passive_stop import Threats
from viaspline.trajectory.retime import braking
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles

SPACING_M: Final = 0.1
"""From place to place along a path [m]."""

FIRST_STEPS_M: Final = (0.001, 0.003, 0.006, 0.012, 0.025, 0.05)
"""Places of a law, from where the robot is, that lie closer together: one that stands near to what
might come goes no farther than that in the time in which it can still stand again [m]."""

SAME_PLACE_M: Final = 1e-9
"""Places of a law that are nearer to each other are one [m]."""


@dataclass(frozen=True, eq=False)
class PassivePremises:
    """What may come, by one look: what passive safety is proven against.

    Attributes:
        tubes: What was seen to move or may move, each in its tube; none of them jumps.
        seen_at: When the look was [s].
        top_speed: Nothing is faster [m/s].
        eye: Where the look was taken [m], shape (2,) or longer.
        reach: All that is there and nearer was seen, or is behind a mouth [m].
        mouths: Lines through which what was hidden may come [m], ``x0, y0, x1, y1``, shape (k, 4).
    """

    tubes: MovingObstacles
    seen_at: float
    top_speed: float
    eye: tuple[float, ...]
    reach: float = math.inf
    mouths: Floats = field(default_factory=lambda: np.empty((0, 4)))

    @cached_property
    def packed(self) -> Threats:
        """What kernels take."""
        eye, mouths = np.array(self.eye[:2], np.float64), np.ascontiguousarray(self.mouths)
        return Threats(
            self.tubes.packed, float(self.seen_at), float(self.top_speed), eye, float(self.reach),
            mouths.reshape(-1, 4).astype(np.float64),
        )  # fmt: skip


@dataclass(frozen=True, eq=False)
class ChordTable:
    """A part of a path as kernels take it: places at multiples of ``SPACING_M``.

    Attributes:
        origin: The distance along the path of the first of them [m].
        places: [m], shape (n, 2), n >= 2; the chord in which the path ends goes on beyond it.
        sag: How far the path may be from the chords between them [m].
    """

    origin: float
    places: Floats
    sag: float

    @classmethod
    def of(cls, path: Path, start: float, end: float) -> ChordTable:
        """The part of a path between two distances along it [m].

        Of two places A and B at a distance l along the path and a chord c, a place P between them
        that is w l behind A is at most w l from A and (1 - w) l from B. So the place Q that is as
        far along the chord is near it (Stewart's theorem):

            |PQ|² = (1-w) |PA|² + w |PB|² - w (1-w) c² <= w (1-w) (l² - c²) <= (l² - c²) / 4.
        """
        first = math.floor(start / SPACING_M)
        last = max(math.ceil(end / SPACING_M), first + 1)
        along = np.minimum(SPACING_M * np.arange(first, last + 1), path.length)
        places = np.ascontiguousarray(np.asarray(path.at_distance(along))[:, :2])
        steps, chords = np.diff(along), np.diff(places, axis=0)
        left = np.maximum(steps**2 - (chords**2).sum(axis=1), 0.0)
        short = int((steps > SAME_PLACE_M).sum()) - 1  # where the path ends within a step
        if short >= 0:
            places[short + 1 :] = places[short] + chords[short] * (SPACING_M / steps[short])
        return cls(first * SPACING_M, places, 0.5 * math.sqrt(float(left.max())))


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
    found = kernels.first_contact(premises.packed, part.places, SPACING_M, keep + part.sag, pieces)
    return float(found)


def passive_law(
    path: Path,
    upper: Trajectory,
    premises: PassivePremises,
    keep: float,
    limits: tuple[float, float],
    now: float,
    lasting: float = math.inf,
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

    Returns:
        (the law, whether it is proven). Not proven: not even braking at once is, and that is the
        law.

    Raises:
        GeometryError: When the law limits the jerk, or begins before the look.

    Example:
        >>> from viaspline.trajectory.limits import Limits
        >>> from viaspline.trajectory.retime import retime
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
    kept = keep + part.sag + 2.0 * kernels.LEAST_GAP  # so that a check finds it proven, too
    distances, squares, proven = kernels.passive_profile(
        premises.packed, part.places, SPACING_M, kept, accel, brake, line - part.origin, caps,
        speed, now, lasting,
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
    speeds: Floats = kernels.stoppable_speeds(
        premises.packed, part.places, SPACING_M, keep + part.sag, brake, along - part.origin,
        instants, highest,
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
