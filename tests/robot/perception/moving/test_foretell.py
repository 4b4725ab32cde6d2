"""What is foretold contains what comes, as long as the premises hold."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.moving.foretell import foretold
from viaspline.robot.perception.moving.motion_sensor import MotionSensor, MovingSighting
from viaspline.robot.perception.moving.track_sightings import TrackedSightings
from viaspline.tracks.foresight import Foresight
from viaspline.tracks.motion_estimate import AxisCovariance, MotionEstimate
from viaspline.world.moving_obstacles import MovingObstacles

SHAPES = (
    {"circle": {"center": (0.2, 0.1), "radius": 0.4}},
    {"capsule": {"from": (-0.5, 0.0), "to": (0.5, 0.2), "radius": 0.2}},
    {"polygon": ((-1.0, -0.4), (1.0, -0.4), (1.0, 0.4), (-1.0, 0.4))},
)
numbers = st.floats(-3, 3)


@given(st.integers(0, 2), numbers, numbers, st.floats(-1.4, 1.4), st.floats(-1.4, 1.4),
       st.floats(-180, 180), st.booleans(), st.floats(0, 0.3), st.integers(0, 99))  # fmt: skip
@settings(deadline=None, max_examples=80)
def test_what_goes_straight_stays_in_its_tube(
    kind: int, x: float, y: float, vx: float, vy: float, heading: float, turning: bool,
    noise: float, seed: int,
) -> None:  # fmt: skip
    """With its whole shape, whether it turns or not: every corner of it is inside."""
    end = heading + (90.0 if turning else 0.0)
    frames = [[0.0, x, y, heading], [10.0, x + 10 * vx, y + 10 * vy, end]]
    motion = {"keyframes": frames, "after": "vanish"}
    truth = MovingObstacles([Obstacle.model_validate({**SHAPES[kind], "motion": motion})])
    sensor = MotionSensor(truth, 90.0, noise, seed)
    tracked = TrackedSightings(noise)
    for k in range(8):
        tracked = tracked.with_sightings(sensor.seen((0, 0), 0.1 * k, k), 0.1 * k)
    tubes = foretold(tracked.tracks, 0.7, Foresight(top_speed=2.0))
    ring = truth.obstacles[0].ring
    assert ring is not None
    corners = np.array(ring.core().buffer(ring.radius).exterior.coords
                       if ring.radius else ring.vertices)  # fmt: skip
    for time in (0.7, 1.2, 2.7, 6.0):
        fx, fy, turned = truth.frames(time)[0]
        c, s = math.cos(turned), math.sin(turned)
        places = np.array((fx, fy)) + corners @ np.array(((c, s), (-s, c)))
        assert tubes.distance(places, time).max() <= 1e-3


@given(numbers, numbers, st.floats(0, 2), st.floats(0, math.tau), st.floats(0, math.tau))
@settings(deadline=None)
def test_what_speeds_up_or_turns_within_its_limits_stays_in_its_tube(
    x: float, y: float, speed: float, way: float, push: float
) -> None:
    estimate = MotionEstimate(
        4.0,
        np.array((x, y, speed * math.cos(way), speed * math.sin(way))),
        AxisCovariance(1e-4, 0.0, 1e-4),
    )
    foresight = Foresight(top_speed=2.0, accel=1.0, horizon=1.5)
    error = foresight.error(estimate)
    state = estimate.mean.copy()
    step = 1e-3
    for k in range(1500):
        state[:2] += step * state[2:]
        state[2:] += step * np.array((math.cos(push), math.sin(push)))
        straight = estimate.place + estimate.velocity * step * (k + 1)
        off = math.dist(state[:2], straight)
        assert off <= error.position_m + error.growth_mps * step * (k + 1) + 1e-9


@given(numbers, numbers, st.floats(0, 2), st.floats(0, math.tau), st.floats(0, math.tau),
       st.floats(0, 0.5), st.floats(0, 3))  # fmt: skip
@settings(deadline=None, max_examples=50)
def test_what_was_missed_for_a_while_is_in_its_tube_wherever_it_turned(
    x: float, y: float, speed: float, way: float, turned: float, missed: float, later: float
) -> None:
    """Strictly: it may turn at will, and go as fast as anything does, since it was seen last."""
    disc = Obstacle.model_validate({"circle": {"center": (0, 0), "radius": 0.3}})
    seen = MovingSighting(0, disc, (x, y, 0.0), (speed * math.cos(way), speed * math.sin(way)))
    tracked = TrackedSightings().with_sightings([seen], 4.0).with_sightings([], 4.0 + missed)
    strict = Foresight(top_speed=2.0, accel=1e6)
    tube = foretold(tracked.tracks, 4.0 + missed, strict)
    gone = 2.0 * (missed + later)
    place = (x + gone * math.cos(turned), y + gone * math.sin(turned))
    assert tube.distance(place, 4.0 + missed + later)[0] <= -0.3 + 1e-6


def test_no_growth_is_more_than_the_top_speed_makes_it() -> None:
    wild = MotionEstimate(0.0, np.array((0.0, 0.0, 1.0, 0.0)), AxisCovariance(100.0, 0.0, 100.0))
    assert Foresight(top_speed=2.0).error(wild).growth_mps == pytest.approx(3.0)


def test_a_shape_that_doesn_t_turn_is_foretold_as_it_stands() -> None:
    frames = [[0.0, 0.0, 0.0, 30.0], [10.0, 10.0, 0.0, 30.0]]
    cart = Obstacle.model_validate(
        {**SHAPES[2], "name": "cart", "motion": {"keyframes": frames, "after": "stay"}}
    )
    sensor = MotionSensor(MovingObstacles([cart]), 90.0)
    tracked = TrackedSightings(0.0).with_sightings(sensor.seen((0, 0), 0.0), 0.0)
    first = foretold(tracked.tracks, 0.0, Foresight(top_speed=2.0)).obstacles[0]
    assert first.circle is not None  # it may be turning
    tracked = tracked.with_sightings(sensor.seen((0, 0), 0.1), 0.1)
    second = foretold(tracked.tracks, 0.1, Foresight(top_speed=2.0)).obstacles[0]
    assert second.name == "cart"
    assert second.polygon is not None
    area = shapely.Polygon(second.polygon)
    assert area.area == pytest.approx(1.6)
    assert shapely.Point(second.polygon[0]).distance(shapely.Point(0, 0)) == pytest.approx(
        1.16**0.5
    )
    assert second.motion is not None
    assert second.motion.velocity_mps == pytest.approx((1.0, 0.0))
