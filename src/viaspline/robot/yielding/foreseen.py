"""What is seen to move, as it is taken to go on for a while.

It goes straight on as it goes now, within what is uncertain of its place and velocity; after that
while it isn't reckoned with, and no longer than it is known at all where it will be: a thing that a
lidar has just seen for the first time might be anywhere soon, and one look later much less so. What
has stood for a while stays: who waits for it to go may wait for ever. What may come otherwise is
the business of passive safety.

Tested through ``robot/yielding/test_foreseen``.
"""

from __future__ import annotations

from collections.abc import Iterable

from viaspline.mission.motion_spec import Motion, MotionError
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.moving.foretell import as_obstacle, reckoned_motion
from viaspline.robot.perception.moving.motion_estimate import MotionEstimate
from viaspline.robot.perception.moving.object_track import ObjectTrack
from viaspline.robot.perception.moving.track_sightings import STOOD_M, SightedTrack
from viaspline.world.moving_obstacles import MovingObstacles

HORIZON_S = 8.0
"""So far ahead it is taken to go straight on [s]."""

LEAST_HORIZON_S = 1.0
"""It is so for so long at least [s]:"""

WIDEST_M = 1.5
"""else until it may be so far from there [m]."""

SIGMAS = 1.0
"""Standard deviations by which it may be elsewhere, or faster. With two, a robot that a lidar shows
things to was led round half of the traffic, which took twice as long."""


def foreseen(tracks: Iterable[ObjectTrack | SightedTrack], now: float) -> MovingObstacles:
    """Where tracked things will be for a while, each on a straight line.

    Args:
        tracks: Each as it is now.
        now: By the clock of motions [s].
    """
    return MovingObstacles.tracked((_foreseen(track, now) for track in tracks), since=now)


def _foreseen(track: ObjectTrack | SightedTrack, now: float) -> Obstacle:
    estimate = track.estimate
    if isinstance(track, SightedTrack) and track.stays:
        return as_obstacle(track, _standing(estimate, now))
    (x, y), (vx, vy) = estimate.place.tolist(), estimate.velocity.tolist()
    error = MotionError(
        position_m=SIGMAS * estimate.place_error, growth_mps=SIGMAS * estimate.velocity_error
    )
    ahead = _horizon(error)
    frames = ((now, x, y), (now + ahead, x + vx * ahead, y + vy * ahead))
    return as_obstacle(track, reckoned_motion(error, frames, after="vanish", before="absent"))


def _standing(estimate: MotionEstimate, now: float) -> Motion:
    """The motion of what stays where it is."""
    x, y = estimate.place.tolist()
    error = MotionError(position_m=max(SIGMAS * estimate.place_error, STOOD_M))
    return reckoned_motion(error, ((now, x, y),), after="stay")


def _horizon(error: MotionError) -> float:
    """How long something is taken to go straight on [s].

    >>> _horizon(MotionError(position_m=0.1, growth_mps=0.7))
    2.0
    """
    spare = WIDEST_M - error.position_m
    if spare >= HORIZON_S * error.growth_mps:
        return HORIZON_S
    return max(spare / error.growth_mps, LEAST_HORIZON_S)
