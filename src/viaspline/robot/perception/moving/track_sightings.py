"""What a range sensor tells of moving things, made smoother from look to look."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

import numpy as np

from viaspline.errors import GeometryError
from viaspline.robot.perception.moving.motion_estimate import MotionEstimate
from viaspline.robot.perception.moving.motion_sensor import MovingSighting

PLACE_ERROR_M: Final = 1e-3
"""A place that is measured exactly, for a filter that divides by its error [m]."""

VELOCITY_ERROR_MPS: Final = 1e-3
"""A velocity that is [m/s]."""

SAME_HEADING_RAD: Final = 1e-9
"""Something turns that has another heading in the next look [rad]."""


@dataclass(frozen=True, eq=False)
class SightedTrack:
    """One moving thing that is in sight.

    Attributes:
        sighting: As it was seen last.
        estimate: Its motion then.
        turns: Whether it may be turning: it was seen only once, or with another heading before.
    """

    sighting: MovingSighting
    estimate: MotionEstimate
    turns: bool

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
        if before is None:
            variances = np.array((PLACE_ERROR_M, PLACE_ERROR_M, error, error)) ** 2
            estimate = MotionEstimate(time, measured, np.diag(variances))
            return SightedTrack(sighting, estimate, turns=True)
        estimate = before.estimate.foreseen(time, self.wander)
        estimate = estimate.with_place_and_velocity(measured, PLACE_ERROR_M, error)
        turned = abs(sighting.frame[2] - before.sighting.frame[2]) > SAME_HEADING_RAD
        return SightedTrack(sighting, estimate, turned)
