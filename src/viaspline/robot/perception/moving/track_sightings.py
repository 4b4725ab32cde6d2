"""What a range sensor tells of moving things, made smoother from look to look."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

import numpy as np

from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.robot.perception.moving.motion_estimate import MotionEstimate
from viaspline.robot.perception.moving.motion_sensor import MovingSighting

PLACE_ERROR_M: Final = 1e-3
"""A place that is measured exactly, for a filter that divides by its error [m]."""

VELOCITY_ERROR_MPS: Final = 1e-3
"""A velocity that is [m/s]."""

SAME_HEADING_RAD: Final = 1e-9
"""Something turns that has another heading in the next look [rad]."""

JUMP_RATIO: Final = 2.0
"""What has gone so many times as far as it would by its speed now and before has jumped,"""

JUMP_SIGMAS: Final = 6.0
"""though the speeds may be wrong by so many standard deviations,"""

JUMP_M: Final = 0.1
"""and by no less than this [m]."""

STOOD_M: Final = 0.02
"""What has gone no farther than this stands [m],"""

STOOD_RAD: Final = 0.02
"""if it has turned no more than this either [rad];"""

STOOD_S: Final = 2.0
"""it is taken to stay when it has stood for so long [s]."""


@dataclass(frozen=True)
class Standstill:
    """Since when something has been where it is.

    Attributes:
        since: [s].
        frame: Where that is: x, y [m], heading [rad].
    """

    since: float
    frame: tuple[float, float, float]

    def going_on(self, frame: tuple[float, float, float], time: float) -> Standstill:
        """It after one more look, at a time [s]: the old one if the thing is still there."""
        near = math.dist(frame[:2], self.frame[:2]) <= STOOD_M
        is_there = near and abs(frame[2] - self.frame[2]) <= STOOD_RAD
        return self if is_there else Standstill(time, frame)


@dataclass(frozen=True, eq=False)
class SightedTrack:
    """One moving thing that is in sight.

    Attributes:
        sighting: As it was seen last.
        estimate: Its motion then.
        still: Since when it has been where it is.
        turns: Whether it may be turning: it was seen only once, or with another heading before.
        jumped: Whether it was somewhere else in the look before: it is followed anew since.
    """

    sighting: MovingSighting
    estimate: MotionEstimate
    still: Standstill
    turns: bool
    jumped: bool = False

    @property
    def stays(self) -> bool:
        """Whether it has stood for so long that it is taken to stay."""
        return self.estimate.time - self.still.since >= STOOD_S

    @property
    def reach(self) -> float:
        """From its frame's origin to the farthest point of its shape [m]."""
        ring = self.sighting.obstacle.ring
        assert ring is not None
        return float(np.hypot(*ring.vertices.T).max()) + ring.radius


@dataclass(frozen=True, eq=False)
class TrackedSightings:
    """The moving things in sight; a new one for every look.

    What isn't told of any more is out of range: nothing is known of it then.

    Attributes:
        velocity_noise: Standard deviation of each coordinate of a velocity that is told [m/s].
        wander: See ``TrackingPremises``.
        tracks: In the order in which they were told of.
        time: Of the latest look [s]; minus infinity before the first.
    """

    velocity_noise: float
    wander: float = 0.4
    tracks: tuple[SightedTrack, ...] = ()
    time: float = -math.inf

    def with_sightings(self, sightings: Iterable[MovingSighting], time: float) -> TrackedSightings:
        """What is known after one more look.

        Args:
            sightings: All that is in range.
            time: Of the look [s].

        Raises:
            GeometryError: When the look is older than the one before.
        """
        if time < self.time:
            raise GeometryError(
                f"a look of {time:g} s came after one of {self.time:g} s; hand looks in in the "
                "order in which they were taken"
            )
        before = {track.sighting.index: track for track in self.tracks}
        tracks = tuple(self._seen(before.get(one.index), one, time) for one in sightings)
        return TrackedSightings(self.velocity_noise, self.wander, tracks, time)

    def _seen(
        self, before: SightedTrack | None, sighting: MovingSighting, time: float
    ) -> SightedTrack:
        error = max(self.velocity_noise, VELOCITY_ERROR_MPS)
        measured = np.array((*sighting.frame[:2], *sighting.velocity))
        jumped = before is not None and _has_jumped(before.estimate, measured, time, error)
        if before is None or jumped:
            variances = np.array((PLACE_ERROR_M, PLACE_ERROR_M, error, error)) ** 2
            estimate = MotionEstimate(time, measured, np.diag(variances))
            still = Standstill(time, sighting.frame)
            return SightedTrack(sighting, estimate, still, turns=True, jumped=jumped)
        estimate = before.estimate.foreseen(time, self.wander)
        estimate = estimate.with_place_and_velocity(measured, PLACE_ERROR_M, error)
        turned = abs(sighting.frame[2] - before.sighting.frame[2]) > SAME_HEADING_RAD
        still = before.still.going_on(sighting.frame, time)
        return SightedTrack(sighting, estimate, still, turned)


def _has_jumped(before: MotionEstimate, measured: Floats, time: float, error: float) -> bool:
    """Whether something is farther from where it was than it can have gone.

    Args:
        before: What was believed of it at the look before.
        measured: x, y [m], vx, vy [m/s] now, shape (4,).
        time: [s].
        error: Standard deviation of a velocity [m/s].
    """
    gone = math.dist(measured[:2], before.place)
    speed = max(math.hypot(*measured[2:].tolist()), math.hypot(*before.velocity.tolist()))
    return gone > JUMP_RATIO * (speed + JUMP_SIGMAS * error) * (time - before.time) + JUMP_M
