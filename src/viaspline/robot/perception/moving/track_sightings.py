"""What a range sensor tells of moving things, made smoother from look to look."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from viaspline.errors import GeometryError
from viaspline.robot.perception.moving.motion_sensor import MovingSighting
from viaspline.tracks.followed import WANDER, Standstill, followed
from viaspline.tracks.motion_estimate import MotionEstimate

SAME_HEADING_RAD: Final = 1e-9
"""Something turns that has another heading in the next look [rad]."""

MISSED_S: Final = 0.5
"""What isn't told of goes on as it was seen to for so long [s], and is taken to have gone then: who
follows things tells of them less often than a robot steps, and misses one now and then."""


@dataclass(frozen=True, eq=False)
class SightedTrack:
    """One moving thing that is in sight, or was a moment ago.

    Attributes:
        sighting: As it was seen last.
        estimate: Its motion then, at the time of that look.
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
        return self.still.stays(self.estimate.time)

    @property
    def reach(self) -> float:
        """From its frame's origin to the farthest point of its shape [m]."""
        ring = self.sighting.obstacle.ring
        assert ring is not None
        return float(np.hypot(*ring.vertices.T).max()) + ring.radius


@dataclass(frozen=True, eq=False)
class TrackedSightings:
    """The moving things in sight; a new one for every look.

    Attributes:
        velocity_noise: Standard deviation of each coordinate of a velocity that is told [m/s].
        wander: See ``TrackingPremises``.
        tracks: In the order in which they were told of; those that were missed come last.
        time: Of the latest look [s]; minus infinity before the first.
    """

    velocity_noise: float = 0.0
    wander: float = WANDER
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
        seen = tuple(self._seen(before.pop(one.index, None), one, time) for one in sightings)
        missed = (
            replace(one, jumped=False)
            for one in before.values()
            if time - one.estimate.time <= MISSED_S
        )
        return replace(self, tracks=(*seen, *missed), time=time)

    def _seen(
        self, before: SightedTrack | None, sighting: MovingSighting, time: float
    ) -> SightedTrack:
        measured = np.array((*sighting.frame[:2], *sighting.velocity))
        known = None if before is None else before.estimate
        estimate, jumped = followed(known, measured, time, self.velocity_noise, self.wander)
        place, heading = sighting.frame[:2], sighting.frame[2]
        if before is None or jumped:
            still = Standstill(time, place, heading)
            return SightedTrack(sighting, estimate, still, turns=True, jumped=jumped)
        turned = abs(heading - before.sighting.frame[2]) > SAME_HEADING_RAD
        still = before.still.going_on(place, heading, time)
        return SightedTrack(sighting, estimate, still, turned)
