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
from viaspline.robot.perception.moving.object_track import ObjectTrack
from viaspline.robot.perception.moving.track_sightings import SightedTrack
from viaspline.tracks.followed import STOOD_M, WANDER
from viaspline.tracks.motion_estimate import MotionEstimate
from viaspline.tracks.straight_on import SIGMAS, straight_on
from viaspline.world.moving_obstacles import MovingObstacles


def foreseen(tracks: Iterable[ObjectTrack | SightedTrack], now: float) -> MovingObstacles:
    """Where tracked things will be for a while, each on a straight line.

    Args:
        tracks: Each as it is now, or as it was when it was told of last.
        now: By the clock of motions [s].
    """
    return MovingObstacles.tracked((_foreseen(track, now) for track in tracks), since=now)


def _foreseen(track: ObjectTrack | SightedTrack, now: float) -> Obstacle:
    estimate = track.estimate
    if isinstance(track, SightedTrack) and track.stays:
        return as_obstacle(track, _standing(estimate, now))
    if now > estimate.time:
        estimate = estimate.foreseen(now, WANDER)
    (x, y), (vx, vy) = estimate.place.tolist(), estimate.velocity.tolist()
    error, ahead = straight_on(estimate)
    frames = ((now, x, y), (now + ahead, x + vx * ahead, y + vy * ahead))
    return as_obstacle(track, reckoned_motion(error, frames, after="vanish", before="absent"))


def _standing(estimate: MotionEstimate, now: float) -> Motion:
    """The motion of what stays where it is."""
    x, y = estimate.place.tolist()
    error = MotionError(position_m=max(SIGMAS * estimate.place_error, STOOD_M))
    return reckoned_motion(error, ((now, x, y),), after="stay")
