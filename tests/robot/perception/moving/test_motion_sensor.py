"""The sensor of moving things sees exactly what has a part in range, as it goes."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
import shapely.affinity
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.errors import GeometryError
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.moving.motion_sensor import MotionSensor
from viaspline.world.moving_obstacles import MovingObstacles

numbers = st.floats(-20, 20)


def cart(x: float, y: float, vx: float, vy: float) -> Obstacle:
    frames = [[0.0, x, y, 0.0], [10.0, x + 10 * vx, y + 10 * vy, 90.0]]
    return Obstacle(
        polygon=((-1.0, -0.4), (1.0, -0.4), (1.0, 0.4), (-1.0, 0.4)),
        motion={"keyframes": frames, "after": "vanish"},
    )


@given(st.lists(st.tuples(numbers, numbers, st.floats(-2, 2), st.floats(-2, 2)), max_size=5),
       st.floats(0, 9.9), st.floats(0.5, 30))  # fmt: skip
@settings(deadline=None, max_examples=60)
def test_what_is_in_range_is_seen_where_it_is(
    rows: list[tuple[float, float, float, float]], time: float, reach: float
) -> None:
    sensor = MotionSensor(MovingObstacles(cart(*row) for row in rows), reach)
    seen = {sighting.index: sighting for sighting in sensor.seen((1.0, 2.0), time)}
    for i, (x, y, vx, vy) in enumerate(rows):
        box = shapely.affinity.rotate(shapely.box(-1, -0.4, 1, 0.4), 9.0 * time, origin=(0, 0))
        there = shapely.affinity.translate(box, x + vx * time, y + vy * time)
        gap = shapely.distance(there, shapely.Point(1.0, 2.0))
        if abs(gap - reach) < 1e-6:
            continue
        assert (i in seen) == (gap <= reach)
        if i in seen:
            expected = (x + vx * time, y + vy * time, np.deg2rad(9.0 * time))
            assert seen[i].frame == pytest.approx(expected)
            assert seen[i].velocity == pytest.approx((vx, vy))


def test_what_isn_t_there_any_more_is_not_seen() -> None:
    sensor = MotionSensor(MovingObstacles([cart(0, 0, 0, 0)]), 5.0)
    assert [len(sensor.seen((0, 0), time)) for time in (-1.0, 5.0, 11.0)] == [0, 1, 0]


def test_the_noise_has_its_deviation_and_is_that_of_seed_and_number() -> None:
    moving = MovingObstacles([cart(0, 0, 0.1, 0)] * 40)
    sensor = MotionSensor(moving, 30.0, velocity_noise_mps=0.2, seed=3)
    errors = np.array(
        [one.velocity for k in range(50) for one in sensor.seen((0, 0), 1.0, number=k)]
    ) - (0.1, 0.0)
    assert abs(errors.std() - 0.2) < 0.01
    assert np.abs(errors).max() <= 0.6 + 1e-12
    again = MotionSensor(moving, 30.0, velocity_noise_mps=0.2, seed=3)
    assert again.seen((0, 0), 1.0, number=7) == sensor.seen((0, 0), 1.0, number=7)
    assert again.seen((0, 0), 1.0, number=7) != sensor.seen((0, 0), 1.0, number=8)


@pytest.mark.parametrize(("reach", "noise"), [(0.0, 0.0), (float("nan"), 0.0), (1.0, -1.0)])
def test_a_sensor_that_can_t_be_is_refused(reach: float, noise: float) -> None:
    with pytest.raises(GeometryError):
        MotionSensor(MovingObstacles(), reach, noise)
