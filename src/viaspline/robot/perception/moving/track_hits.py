"""The hits of a lidar told apart: what stands, and what moves or may move, followed over time."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from scipy.optimize import linear_sum_assignment

from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Flags, Floats
from viaspline.robot.perception.lidar import MAX_NOISE_SIGMAS, Scan
from viaspline.robot.perception.moving.hit_clusters import JOIN_M, HitCluster, clusters_of
from viaspline.robot.perception.moving.moved_away import Glimpse, has_come, is_seen_through
from viaspline.robot.perception.moving.object_track import ObjectTrack, measured_error
from viaspline.robot.perception.moving.tracking_premises import TrackingPremises
from viaspline.world.world import World

GATE: Final = 16.0
"""Squared Mahalanobis distance beyond which a cluster is another thing: one in 3,000 isn't."""

FAR: Final = 1e9
"""The price of taking a cluster for a thing that it can't be."""

MAX_DOUBTS: Final = 2
"""A thing is forgotten when so many looks in a row have seen through its place."""

LOOK_INTERVAL_S: Final = 0.2
"""From one look to the next that is remembered [s],"""

LOOKS: Final = 5
"""and how many are."""

ON_SURFACE_M: Final = 0.02
"""A hit nearer than this to what is known to stand shows just that, beside the noise [m]."""


@dataclass(frozen=True, eq=False)
class TrackedHits:
    """What a lidar has shown of things that move; a new one for every scan.

    Attributes:
        premises: What is taken for granted.
        tracks: Things that move or may move, in the order in which they were first seen.
        time: Of the latest scan [s]; minus infinity before the first.
        next_number: That of the next thing.
        looks: Earlier scans, each with its time, the latest first.
    """

    premises: TrackingPremises
    tracks: tuple[ObjectTrack, ...] = ()
    time: float = -np.inf
    next_number: int = 1
    looks: tuple[tuple[float, Scan], ...] = ()

    def with_scan(self, scan: Scan, time: float, known: World) -> tuple[TrackedHits, Flags]:
        """What is known after one more scan, and which of its hits show what stands.

        All other hits lie in the discs of tracks.

        Args:
            scan: A look round.
            time: When it was taken [s].
            known: What is known to stand.

        Returns:
            (what is known of moving things, shape (h,): whether each of ``scan.hits`` stands).

        Raises:
            GeometryError: When the scan is older than the one before.
        """
        if time < self.time:
            raise GeometryError(
                f"a scan of {time:g} s came after one of {self.time:g} s; hand scans in in the "
                "order in which they were taken"
            )
        noise, scans = self.premises.noise, [scan for _, scan in self.looks]
        distance = known.distance(scan.hits) if len(scan.hits) else np.empty(0)
        standing: Flags = distance <= ON_SURFACE_M + MAX_NOISE_SIGMAS * noise
        clusters = clusters_of(scan, ~standing)
        glimpses = [Glimpse(time, scan, c.points, c.radius) for c in clusters]
        foreseen = [track.foreseen(time, self.premises) for track in self.tracks]
        pairs = _assigned(foreseen, clusters, glimpses)
        tracks: list[ObjectTrack] = []
        for i, track in enumerate(foreseen):
            if i in pairs:
                cluster, glimpse = clusters[pairs[i]], glimpses[pairs[i]]
                seen = track.with_cluster(cluster, glimpse, scans, self.premises)
                if seen.stands(self.premises):
                    standing[cluster.hits] = True
                else:
                    tracks.append(seen)
            elif (unseen := self._unseen(track, scan, time, clusters)) is not None:
                tracks.append(unseen)
        number = self.next_number
        for k in sorted(set(range(len(clusters))) - set(pairs.values())):
            came = has_come(glimpses[k], scans, noise)
            if not came and self._seems_to_stand(clusters[k], distance):
                standing[clusters[k].hits] = True
                continue
            tracks.append(
                ObjectTrack.at_first_sight(number, glimpses[k], clusters[k], self.premises)
            )
            number += 1
        return TrackedHits(
            self.premises, tuple(tracks), time, number, self._remembered(scan, time)
        ), standing

    def _seems_to_stand(self, cluster: HitCluster, distance: Floats) -> bool:
        """Whether what first comes into sight is a part of what stands, or too long to move."""
        is_long = 2.0 * cluster.radius > self.premises.longest_m
        return is_long or bool(distance[cluster.hits].min() <= JOIN_M)

    def _unseen(
        self, track: ObjectTrack, scan: Scan, time: float, clusters: Sequence[HitCluster]
    ) -> ObjectTrack | None:
        """A thing that no cluster was taken for; None if it is forgotten."""
        premises, place = self.premises, track.estimate.place
        if time - track.seen > premises.forget_s or track.estimate.place_error > premises.lost_m:
            return None
        if any(np.hypot(*(c.center - place)) <= c.radius + track.radius for c in clusters):
            return track
        if not is_seen_through(place, track.radius, scan, premises.noise):
            return track
        doubted = replace(track, doubts=track.doubts + 1)
        return None if doubted.doubts >= MAX_DOUBTS else doubted

    def _remembered(self, scan: Scan, time: float) -> tuple[tuple[float, Scan], ...]:
        if self.looks and time < self.looks[0][0] + LOOK_INTERVAL_S - 1e-9:
            return self.looks
        return ((time, scan), *self.looks[: LOOKS - 1])


def _assigned(
    tracks: Sequence[ObjectTrack], clusters: Sequence[HitCluster], glimpses: Sequence[Glimpse]
) -> dict[int, int]:
    """Which cluster is which thing: the likeliest of all ways to pair them, by their indices."""
    if not (tracks and clusters):
        return {}
    price: Floats = np.full((len(tracks), len(clusters)), FAR)
    for (i, track), (k, cluster) in itertools.product(enumerate(tracks), enumerate(clusters)):
        error = measured_error(cluster, glimpses[k], track)
        apart = math.dist(cluster.center, track.estimate.place)
        if apart > math.sqrt(GATE) * math.hypot(track.estimate.place_error, error):
            continue  # by the greater axis of the ellipse
        away, scale = track.estimate.distance_to(cluster.center, error)
        if away <= GATE:
            price[i, k] = away + scale
    rows, columns = linear_sum_assignment(price)
    found = zip(rows.tolist(), columns.tolist(), strict=True)
    return {i: k for i, k in found if price[i, k] < FAR}
