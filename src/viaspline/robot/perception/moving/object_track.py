"""One thing that moves or may move, followed from look to look.

Tested through ``robot/perception/moving/test_track_hits``.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.robot.perception.lidar import Scan
from viaspline.robot.perception.moving.hit_clusters import HitCluster
from viaspline.robot.perception.moving.moved_away import Glimpse, has_come, has_moved
from viaspline.robot.perception.moving.tracking_premises import TrackingPremises
from viaspline.tracks.motion_estimate import MotionEstimate

SIGNIFICANT: Final = 5.99
"""Squared Mahalanobis distance from rest that one velocity of twenty has by chance."""

LEAST_ERROR_M: Final = 0.02
"""The middle of what is seen is measured no better than this [m];"""

WIDTH_ERROR: Final = 0.04
"""nor than this part of its radius,"""

BEAM_ERROR: Final = 0.5
"""and this part of the distance from beam to beam."""

MAX_SHIFT_M: Final = 0.3
"""A part of a thing, or a thing with another, shows a middle that is so far off at most [m]."""

CREEP_M: Final = 0.1
"""A thing whose middle is so far from where it first was isn't yet said to stand [m]."""

MOVED_M: Final = 0.3
"""One that has gone so far, and left free what it stood on, moves, however slowly [m]."""

SHRINKING_MPS: Final = 1.0
"""A thing that shows less of itself than before is taken for smaller by so much in a second [m/s]:
one that was merged with another gets its own size back."""


@dataclass(frozen=True, eq=False)
class ObjectTrack:
    """What is known of one thing.

    Attributes:
        number: Which one it is, as long as it is followed; never given to another.
        estimate: Its motion at the time of the latest look; the place is the middle of its disc.
        radius: Of a disc about that place in which all hits of it lay when it was last seen [m].
        seen: When that was [s].
        moves: Whether it was seen to move; else that isn't decided yet.
        anchor: How it looked when it was last seen to move, or first seen,
        anchor_place: and where its middle seemed to be [m], shape (2,).
        suspected: Whether the latest look differs from the anchor as if it had moved.
        doubts: Looks in a row that have seen through where it should be.
    """

    number: int
    estimate: MotionEstimate
    radius: float
    seen: float
    moves: bool
    anchor: Glimpse
    anchor_place: Floats
    suspected: bool = False
    doubts: int = 0

    @classmethod
    def at_first_sight(
        cls, number: int, glimpse: Glimpse, cluster: HitCluster, premises: TrackingPremises
    ) -> ObjectTrack:
        """A thing that a look shows for the first time."""
        x, y = cluster.center.tolist()
        error = measured_error(cluster, glimpse, None)
        estimate = MotionEstimate.at_first_sight(glimpse.time, (x, y), error, premises.top_speed)
        return cls(number, estimate, cluster.radius, glimpse.time, False, glimpse, cluster.center)

    def foreseen(self, time: float, premises: TrackingPremises) -> ObjectTrack:
        """Where it should be at a later time [s]."""
        return replace(self, estimate=self.estimate.foreseen(time, premises.wander))

    def with_cluster(
        self,
        cluster: HitCluster,
        glimpse: Glimpse,
        looks: Iterable[Scan],
        premises: TrackingPremises,
    ) -> ObjectTrack:
        """What is known after it was seen again; it has been foreseen for that time.

        The disc about the new place contains all of the hits: of two things that have met one
        track may go on for both.

        Args:
            cluster: What was seen of it.
            glimpse: In which look.
            looks: Some of the looks before.
            premises: What is taken for granted.
        """
        error = measured_error(cluster, glimpse, self)
        estimate = self.estimate.with_place(cluster.center, error)
        covering = float(np.hypot(*(cluster.points - estimate.place).T).max())
        kept = self.radius
        if not cluster.is_cut:
            kept -= SHRINKING_MPS * (glimpse.time - self.seen)
        radius = max(covering, cluster.radius, kept)
        moved = has_moved(self.anchor, glimpse, premises.noise) or has_come(
            glimpse, looks, premises.noise
        )
        track = replace(
            self, estimate=estimate, radius=radius, seen=glimpse.time, suspected=moved, doubts=0
        )
        is_fast = estimate.significance > SIGNIFICANT or track.has_gone(MOVED_M)
        if moved and (track.moves or is_fast):
            return replace(track, moves=True, anchor=glimpse, anchor_place=cluster.center)
        return track

    def stands(self, premises: TrackingPremises) -> bool:
        """Whether it hasn't moved for so long that it stands."""
        still = self.seen - self.anchor.time + 1e-9
        if self.moves:
            return still >= premises.rest_s
        seems_to = self.suspected or self.has_gone(CREEP_M)
        if seems_to or self.estimate.significance > SIGNIFICANT:
            return still >= premises.doubt_s
        return still >= premises.settle_s

    def has_gone(self, far: float) -> bool:
        """Whether its middle is that far [m] from its anchor: so is one of which more is seen."""
        return math.dist(self.estimate.place, self.anchor_place) > far


def measured_error(cluster: HitCluster, glimpse: Glimpse, track: ObjectTrack | None) -> float:
    """Standard deviation of each coordinate of the middle of a cluster [m].

    Args:
        cluster: What was seen.
        glimpse: In which look.
        track: What it should be; a cluster that is larger, or of which a part is hidden, may show
            another middle than that has.
    """
    away = math.dist(cluster.center, glimpse.scan.position[:2])
    beam = BEAM_ERROR * glimpse.scan.angle_increment * away
    error = math.hypot(LEAST_ERROR_M, WIDTH_ERROR * cluster.radius, beam)
    if track is None:
        return math.hypot(error, MAX_SHIFT_M) if cluster.is_cut else error
    other = max(cluster.radius - track.radius, 0.0)
    if cluster.is_cut:
        other = max(other, track.radius - cluster.radius)
    return math.hypot(error, min(other, MAX_SHIFT_M))
