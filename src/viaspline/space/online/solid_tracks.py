"""What a range sensor in space tells of moving things, made smoother from look to look."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from viaspline.space.among.moving_solid import LONGEST_CELL_S, MovingSolid
from viaspline.space.online.solid_sensor import SolidSighting
from viaspline.tracks.followed import STOOD_M, WANDER, Standstill, followed
from viaspline.tracks.motion_estimate import MotionEstimate
from viaspline.tracks.straight_on import SIGMAS, straight_on


@dataclass(frozen=True, eq=False)
class SolidTrack:
    """One moving thing that is in sight.

    Attributes:
        sighting: As it was seen last.
        estimate: Its motion then.
        still: Since when it has been where it is.
        jumped: Whether it was somewhere else in the look before: it is followed anew since.
    """

    sighting: SolidSighting
    estimate: MotionEstimate
    still: Standstill
    jumped: bool = False

    @property
    def name(self) -> str:
        """What it is called."""
        return self.sighting.solid.name

    def foreseen(self, now: float, until: float, apart: float) -> MovingSolid:
        """Where it will be: straight on for a while, in a tube that grows, and then not at all.

        What has stood for a while stays.

        Args:
            now: When it was seen [s].
            until: Up to when anybody asks [s].
            apart: What is kept from it beyond what is asked for [m].
        """
        radius, half, margin = self.sighting.solid.body
        body = (radius, half, margin + apart)
        place = self.estimate.place
        if self.still.stays(self.estimate.time):
            off = np.full(2, max(SIGMAS * self.estimate.place_error, STOOD_M))
            times = np.array([now, until])
            return MovingSolid(
                self.name, body, times, np.array([place, place]), np.ones(2, np.bool_), off
            )
        error, ahead = straight_on(self.estimate)
        late = np.linspace(0.0, ahead, math.ceil(ahead / LONGEST_CELL_S) + 1)
        places = place + late[:, None] * self.estimate.velocity
        times = np.append(now + late, max(until, now + ahead + LONGEST_CELL_S))
        there = np.append(np.ones(len(late) - 1, np.bool_), [False, False])
        off = error.position_m + error.growth_mps * np.append(late[1:], [ahead, ahead])
        return MovingSolid(self.name, body, times, np.append(places, places[-1:], 0), there, off)


@dataclass(frozen=True, eq=False)
class SolidTracks:
    """The moving things in sight; a new one for every look.

    What isn't told of any more is out of range: nothing is known of it then.

    Attributes:
        velocity_noise: Standard deviation of each coordinate of a velocity that is told [m/s].
        tracks: In the order in which they were told of.
    """

    velocity_noise: float
    tracks: tuple[SolidTrack, ...] = ()

    def with_sightings(self, sightings: Iterable[SolidSighting], time: float) -> SolidTracks:
        """What is known after one more look, at a time [s]: all that is in range."""
        before = {track.sighting.index: track for track in self.tracks}
        seen = tuple(self._seen(before.get(one.index), one, time) for one in sightings)
        return replace(self, tracks=seen)

    def foreseen(self, now: float, until: float, apart: float) -> tuple[MovingSolid, ...]:
        """Where all of them will be; see `SolidTrack.foreseen`."""
        return tuple(track.foreseen(now, until, apart) for track in self.tracks)

    def _seen(self, before: SolidTrack | None, sighting: SolidSighting, time: float) -> SolidTrack:
        known = None if before is None else before.estimate
        measured = np.array((*sighting.place, *sighting.velocity))
        estimate, jumped = followed(known, measured, time, self.velocity_noise, WANDER)
        place = tuple(sighting.place.tolist())
        if before is None or jumped:
            return SolidTrack(sighting, estimate, Standstill(time, place), jumped)
        return SolidTrack(sighting, estimate, before.still.going_on(place, 0.0, time))
