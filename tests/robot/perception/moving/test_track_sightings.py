"""Sightings make tracks of those in sight, whose velocities get better from look to look."""

from __future__ import annotations

import math

import numpy as np
import pytest

from viaspline.errors import GeometryError
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.moving.motion_sensor import MotionSensor
from viaspline.robot.perception.moving.track_sightings import TrackedSightings
from viaspline.world.moving_obstacles import MovingObstacles


def discs(*rows: tuple[float, float, float, float]) -> MovingObstacles:
    return MovingObstacles(
        Obstacle.model_validate(
            {
                "circle": {"center": (0, 0), "radius": 0.3},
                "motion": {"from": (x, y), "velocity_mps": (vx, vy)},
            }
        )
        for x, y, vx, vy in rows
    )


def test_velocities_get_better_than_they_are_measured() -> None:
    rng = np.random.default_rng(2)
    rows = [tuple(row) for row in rng.uniform(-1, 1, (60, 4)).tolist()]
    moving = discs(*rows)
    sensor = MotionSensor(moving, 99.0, velocity_noise_mps=0.3, seed=1)
    tracked, errors = TrackedSightings(0.3), []
    for k in range(12):
        tracked = tracked.with_sightings(sensor.seen((0, 0), 0.1 * k, k), 0.1 * k)
        off = [math.dist(t.estimate.velocity, rows[t.sighting.index][2:]) for t in tracked.tracks]
        errors.append(float(np.sqrt(np.mean(np.square(off)))))
    assert errors[0] == pytest.approx(0.3 * math.sqrt(2), rel=0.2)
    assert errors[-1] < 0.1
    worst = max(
        math.dist(t.estimate.velocity, rows[t.sighting.index][2:]) / t.estimate.velocity_error
        for t in tracked.tracks
    )
    assert worst < 3.0


def test_tracks_are_those_in_range_and_keep_their_index() -> None:
    sensor = MotionSensor(discs((3, 0, 1, 0), (-9, 0, 2, 0), (0, 30, 0, 0)), 5.0)
    tracked = TrackedSightings(0.0)
    seen = []
    for k in range(60):
        tracked = tracked.with_sightings(sensor.seen((0, 0), 0.1 * k), 0.1 * k)
        seen.append({t.sighting.index for t in tracked.tracks})
    assert seen[0] == {0}
    assert seen[-1] == {1}
    assert all(2 not in each for each in seen)


def test_what_is_missed_is_kept_for_half_a_second() -> None:
    sensor = MotionSensor(discs((3, 0, 1, 0)), 99.0)
    tracked = TrackedSightings().with_sightings(sensor.seen((0, 0), 0.0), 0.0)
    missed = tracked.with_sightings((), 0.2).with_sightings((), 0.5)
    assert [track.sighting.index for track in missed.tracks] == [0]
    assert missed.with_sightings((), 0.6).tracks == ()
    again = missed.with_sightings(sensor.seen((0, 0), 0.55), 0.55)
    assert [track.estimate.time for track in again.tracks] == [0.55]
    assert not again.tracks[0].jumped


def test_who_jumped_and_is_missed_then_has_not_jumped_again() -> None:
    tracked = TrackedSightings()
    for time, moving in ((0.0, discs((3, 0, 1, 0))), (0.1, discs((9, 0, 1, 0)))):
        tracked = tracked.with_sightings(MotionSensor(moving, 99.0).seen((0, 0), time), time)
    assert tracked.tracks[0].jumped
    assert not tracked.with_sightings((), 0.2).tracks[0].jumped


def test_looks_come_in_the_order_in_which_they_were_taken() -> None:
    with pytest.raises(GeometryError, match="order"):
        TrackedSightings(0.0).with_sightings((), 2.0).with_sightings((), 1.0)
