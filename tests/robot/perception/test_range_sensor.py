"""The range sensor sees exactly what has a part in range."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from viaspline.errors import GeometryError
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.range_sensor import RangeSensor

coordinates = st.floats(-50, 50)


@given(st.lists(st.tuples(coordinates, coordinates, st.floats(0.1, 9)), max_size=6),
       coordinates, coordinates, st.floats(0.1, 30))  # fmt: skip
def test_a_disc_is_seen_when_its_edge_is_in_range(
    discs: list[tuple[float, float, float]], x: float, y: float, reach: float
) -> None:
    obstacles = [Obstacle(circle=Circle(center=(a, b), radius=r)) for a, b, r in discs]
    seen = RangeSensor(obstacles, reach).seen((x, y))
    for obstacle, (a, b, r) in zip(obstacles, discs, strict=True):
        gap = np.hypot(a - x, b - y) - r
        if abs(gap - reach) > 1e-9:
            assert (obstacle in seen) == (gap <= reach)


@given(coordinates, coordinates, st.floats(0.1, 30))
def test_a_polygon_with_a_hole_is_seen_by_its_material(x: float, y: float, reach: float) -> None:
    ring = ((-30.0, -30.0), (30.0, -30.0), (30.0, 30.0), (-30.0, 30.0))
    hole = ((-20.0, -20.0), (20.0, -20.0), (20.0, 20.0), (-20.0, 20.0))
    obstacle = Obstacle(polygon=ring, holes=(hole,))
    gap = shapely.Polygon(ring, [hole]).distance(shapely.Point(x, y))
    seen = RangeSensor([obstacle], reach).seen((x, y))
    if abs(gap - reach) > 1e-9:
        assert bool(seen) == (gap <= reach)


def test_the_first_sight_is_the_first_position_that_sees_something_unknown() -> None:
    near = Obstacle(circle=Circle(center=(10, 0), radius=2), name="near")
    far = Obstacle(circle=Circle(center=(20, 0), radius=2), name="far")
    sensor = RangeSensor([far, near], 5.0)
    walk = np.stack((np.arange(0.0, 30.0), np.zeros(30)), axis=1)
    assert sensor.first_sight(walk, ()) == 3
    assert sensor.first_sight(walk, {near}) == 13
    assert sensor.first_sight(walk, {near, far}) is None


def test_nothing_to_see_is_nothing_seen() -> None:
    sensor = RangeSensor([], 5.0)
    assert sensor.seen((0.0, 0.0)) == ()
    assert sensor.first_sight(np.zeros((3, 2)), ()) is None


def test_a_robot_in_space_sees_what_is_below_it() -> None:
    rock = Obstacle(circle=Circle(center=(3, 0), radius=2))
    assert RangeSensor([rock], 5.0).seen((0.0, 0.0, 40.0)) == (rock,)


def test_a_range_is_above_zero() -> None:
    with pytest.raises(GeometryError, match="range_m is 0"):
        RangeSensor([], 0.0)
