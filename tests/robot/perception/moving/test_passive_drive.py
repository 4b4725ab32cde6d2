"""A robot that looks, foretells and drives by passive laws stands before anything touches it."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.path import Path
from viaspline.mission.sensor_spec import Lidar
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.lidar import LidarSensor
from viaspline.robot.perception.moving.foretell import foretold
from viaspline.robot.perception.moving.motion_sensor import MotionSensor
from viaspline.robot.perception.moving.mouths import reach_and_mouths
from viaspline.robot.perception.moving.track_hits import TrackedHits
from viaspline.robot.perception.moving.track_sightings import TrackedSightings
from viaspline.robot.perception.moving.tracking_premises import TrackingPremises
from viaspline.tracks.foresight import Foresight
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.passive_premises import PassivePremises
from viaspline.trajectory.passive_safety import passive_law, stop_of
from viaspline.trajectory.retime import braking, retime
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.world import World

RADIUS, TOP, STEP, SECONDS = 0.25, 1.5, 0.1, 14.0
SPANS = [[(0, 0), (4, 0), (8, 1), (12, 1)]]
LIMITS = Limits(max_speed=2.0, max_accel=1.0)
ANYWHERE = Foresight(top_speed=TOP, accel=1e6)

Look = Callable[[np.ndarray, float, int], PassivePremises]


def bouncing(corners: list[tuple[float, float]], speed: float) -> Obstacle:
    """A disc that goes to and fro between places, none faster than ``TOP``."""
    times = np.cumsum([0.0, *(math.dist(a, b) / speed + 0.01 for a, b in
                              itertools.pairwise(corners))])  # fmt: skip
    frames = [(t, x, y) for t, (x, y) in zip(times.tolist(), corners, strict=True)]
    motion = {"keyframes": frames, "after": "bounce"}
    circle = {"center": (0, 0), "radius": 0.4}
    return Obstacle.model_validate({"circle": circle, "motion": motion})


def by_range(moving: MovingObstacles) -> Look:
    sensor, tracked = MotionSensor(moving, 6.0, velocity_noise_mps=0.2), TrackedSightings(0.2)

    def look(place: np.ndarray, time: float, number: int) -> PassivePremises:
        nonlocal tracked
        tracked = tracked.with_sightings(sensor.seen(place, time, number), time)
        tubes = foretold(tracked.tracks, time, ANYWHERE)
        return PassivePremises(tubes, time, TOP, tuple(place.tolist()), 6.0)

    return look


def by_lidar(moving: MovingObstacles) -> Look:
    spec = Lidar(range_m=8.0, fov_deg=360, beams=720, noise_m=0.01)
    sensor = LidarSensor([], spec, moving=moving)
    tracked = TrackedHits(TrackingPremises(top_speed=TOP, noise=0.01))

    def look(place: np.ndarray, time: float, number: int) -> PassivePremises:
        nonlocal tracked
        at = tuple(place.tolist())
        scan = sensor.scan(at, 0.0, number, time)
        tracked, _ = tracked.with_scan(scan, time, World())
        tubes = foretold(tracked.tracks, time, ANYWHERE)
        reach, mouths = reach_and_mouths(scan, 0.3)
        return PassivePremises(tubes, time, TOP, at, reach, mouths)

    return look


def speeds_at_contact(moving: MovingObstacles, look: Look) -> tuple[list[float], float]:
    """How fast the robot is whenever something touches it, and how far it comes."""
    path = Path(SPANS, [])
    law, found = braking(0.0, 0.0, 1.0, 0.0), []
    for k in range(round(SECONDS / STEP)):
        now = STEP * k
        here, speed, _ = (float(value) for value in law.state_at(now))
        upper = retime(path, LIMITS, start=here, start_speed=speed, start_time=now)
        premises = look(np.asarray(path.at_distance(here)), now, k)
        found_law, proven = passive_law(path, upper, premises, RADIUS, (1.0, 1.0), now, 1.0)
        law = found_law if proven else stop_of(law, now, 1.0)
        times = now + np.linspace(0.0, STEP, 21)
        distances, speeds, _ = law.state_at(times)
        touched = moving.distance(path.at_distance(distances), times) < RADIUS
        found += speeds[touched].tolist()
        if here > path.length - 0.1:
            break
    return found, here


corners = st.lists(st.tuples(st.floats(-1, 13), st.floats(-6, 6)), min_size=2, max_size=5)
scenes = st.lists(st.tuples(corners, st.floats(0.3, TOP)), min_size=1, max_size=5)


@pytest.mark.slow
@pytest.mark.parametrize("eyes", [by_range, by_lidar])
@given(scenes)
@settings(deadline=None, max_examples=12)
def test_it_stands_whenever_something_touches_it(
    eyes: Callable[[MovingObstacles], Look], rows: list[tuple[list[tuple[float, float]], float]]
) -> None:
    """Whatever moves turns at once, and heads for the robot's path without regard to it."""
    rows = [row for row in rows if math.hypot(*row[0][0]) > 1.0]
    moving = MovingObstacles(bouncing(*row) for row in rows)
    speeds, _ = speeds_at_contact(moving, eyes(moving))
    assert max(speeds, default=0.0) < 1e-3


@pytest.mark.parametrize("eyes", [by_range, by_lidar])
def test_it_arrives_where_what_moves_stays_away(eyes: Callable[[MovingObstacles], Look]) -> None:
    moving = MovingObstacles([bouncing([(3, 9), (9, 9)], 1.0)])
    speeds, come = speeds_at_contact(moving, eyes(moving))
    assert not speeds
    assert come > Path(SPANS, []).length - 0.2
