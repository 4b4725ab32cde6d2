"""What is seen to move, as it is taken to go on for a while.

It goes straight on as it goes now, within what is uncertain of its place and velocity; after that
while it isn't reckoned with. What may come otherwise is the business of passive safety.

Tested through ``robot/yielding/test_foreseen``.
"""

from __future__ import annotations

from collections.abc import Iterable

from viaspline.mission.motion_spec import Motion, MotionError
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.moving.foretell import as_obstacle
from viaspline.robot.perception.moving.object_track import ObjectTrack
from viaspline.robot.perception.moving.track_sightings import SightedTrack
from viaspline.world.moving_obstacles import MovingObstacles

HORIZON_S = 8.0
"""So far ahead it is taken to go straight on [s]."""

SIGMAS = 2.0
"""Standard deviations by which it may be elsewhere, or faster."""


def foreseen(tracks: Iterable[ObjectTrack | SightedTrack], now: float) -> MovingObstacles:
    """Where tracked things will be for a while, each on a straight line.

    Args:
        tracks: Each as it is now.
        now: By the clock of motions [s].
    """
    return MovingObstacles((_foreseen(track, now) for track in tracks), since=now)


def _foreseen(track: ObjectTrack | SightedTrack, now: float) -> Obstacle:
    estimate = track.estimate
    (x, y), (vx, vy) = estimate.place.tolist(), estimate.velocity.tolist()
    later = now + HORIZON_S
    motion = Motion(
        keyframes=((now, x, y), (later, x + vx * HORIZON_S, y + vy * HORIZON_S)),
        after="vanish",
        before="absent",
        error=MotionError(
            position_m=SIGMAS * estimate.place_error,
            growth_mps=SIGMAS * estimate.velocity_error,
        ),
    )
    return as_obstacle(track, motion)
