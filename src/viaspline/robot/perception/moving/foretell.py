"""Where things that were seen to move will be: each on a straight line, in a tube that grows."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Literal

import numpy as np

from viaspline.mission.fields import MIN_LENGTH_M
from viaspline.mission.motion_spec import After, Motion, MotionError
from viaspline.mission.shapes.capsule import Capsule
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.moving.object_track import ObjectTrack
from viaspline.robot.perception.moving.track_sightings import SightedTrack
from viaspline.tracks.foresight import Foresight
from viaspline.world.moving_obstacles import MovingObstacles


def foretold(
    tracks: Iterable[ObjectTrack | SightedTrack], now: float, foresight: Foresight
) -> MovingObstacles:
    """Where tracked things will be, in their order, less certain from now on.

    Args:
        tracks: Each as it is now, or as it was at the time of its estimate.
        now: By the clock of motions [s].
        foresight: What is taken for granted.
    """
    return MovingObstacles.tracked(
        (_foretold(track, now, foresight) for track in tracks), since=now
    )


def _foretold(track: ObjectTrack | SightedTrack, now: float, foresight: Foresight) -> Obstacle:
    estimate = track.estimate
    vx, vy = estimate.velocity.tolist()
    x, y = estimate.place.tolist()
    start = (x - vx * estimate.time, y - vy * estimate.time)
    error = foresight.error_after(now - estimate.time, estimate)
    motion = reckoned_motion(error, start=start, velocity=(vx, vy))
    return as_obstacle(track, motion)


def reckoned_motion(
    error: MotionError,
    keyframes: tuple[tuple[float, float, float], ...] | None = None,
    *,
    after: After | None = None,
    before: Literal["stay", "absent"] | None = None,
    start: tuple[float, float] | None = None,
    velocity: tuple[float, float] | None = None,
) -> Motion:
    """The motion of something that is tracked, by the clock of whoever drives the robot.

    That may be the seconds since 1970, more than a mission's clock can say: so it isn't held
    against what people may write.

    Args:
        error: How far from there it may be.
        keyframes: Time [s], x, y [m]; or
        after: what it does when they are over,
        before: and before that;
        start: where it is at time 0 [m], and
        velocity: how fast it goes [m/s].
    """
    return Motion.model_construct(
        keyframes=keyframes, after=after, before=before, from_=start, velocity_mps=velocity,
        error=error,
    )  # fmt: skip


def as_obstacle(track: ObjectTrack | SightedTrack, motion: Motion) -> Obstacle:
    """A tracked thing as an obstacle with a motion of its place."""
    if isinstance(track, SightedTrack):
        seen = track.sighting
        name = seen.obstacle.name or f"moving obstacle {seen.index + 1}"
        if not track.turns:
            return _turned(seen.obstacle, seen.frame[2], motion, name)
        return _disc(track.reach, motion, name)
    return _disc(track.radius, motion, f"moving thing {track.number}")


def _disc(radius: float, motion: Motion, name: str) -> Obstacle:
    circle = Circle(center=(0.0, 0.0), radius=max(radius, MIN_LENGTH_M))
    return Obstacle(circle=circle, motion=motion, name=name)


def _turned(obstacle: Obstacle, heading: float, motion: Motion, name: str) -> Obstacle:
    """A shape turned about its frame's origin [rad], in a frame that doesn't turn."""
    ring = obstacle.ring
    assert ring is not None
    if obstacle.circle is not None and obstacle.circle.center == (0.0, 0.0):
        return Obstacle(circle=obstacle.circle, motion=motion, name=name)
    c, s = math.cos(heading), math.sin(heading)
    corners = [(c * x - s * y, s * x + c * y) for x, y in ring.loops[0]]
    if len(corners) == 1:
        circle = Circle(center=corners[0], radius=ring.radius)
        return Obstacle(circle=circle, motion=motion, name=name)
    if len(corners) == 2:
        capsule = Capsule(from_=corners[0], to=corners[1], radius=ring.radius)
        return Obstacle(capsule=capsule, motion=motion, name=name)
    if ring.radius > 0.0:
        return _disc(float(np.hypot(*ring.vertices.T).max()) + ring.radius, motion, name)
    return Obstacle(polygon=tuple(corners), motion=motion, name=name)
