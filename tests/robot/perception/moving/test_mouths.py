"""Whoever comes from where a lidar didn't see crosses a mouth or comes from beyond its reach."""

from __future__ import annotations

import math

import numpy as np
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.mission.sensor_spec import Lidar
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.lidar import LidarSensor, Scan
from viaspline.robot.perception.moving.mouths import reach_and_mouths

posts = st.lists(st.tuples(st.floats(-6, 6), st.floats(-6, 6), st.floats(0.2, 1.0)), max_size=6)


@given(posts, st.tuples(st.floats(-7, 7), st.floats(-7, 7)), st.tuples(st.floats(-5, 5),
       st.floats(-5, 5)))  # fmt: skip
@settings(deadline=None, max_examples=150)
def test_a_way_from_the_unseen_crosses_a_mouth_or_what_stands(
    rows: list[tuple[float, float, float]], start: tuple[float, float], end: tuple[float, float]
) -> None:
    rows = [row for row in rows if math.hypot(row[0], row[1]) > row[2] + 0.1]
    spec = Lidar(range_m=6.0, fov_deg=360.0, beams=720)
    sensor = LidarSensor([Obstacle(circle=Circle(center=(x, y), radius=r)) for x, y, r in rows],
                         spec)  # fmt: skip
    scan = sensor.scan((0.0, 0.0), 0.3)
    reach, mouths = reach_and_mouths(scan, 0.15)
    angles = scan.first_direction + scan.angle_increment * np.arange(720)
    star = shapely.Polygon(scan.free[:, None] * np.column_stack((np.cos(angles), np.sin(angles))))
    way = shapely.LineString([start, end])
    if star.covers(shapely.Point(start)) or not star.contains(shapely.Point(end)):
        return
    enters = shapely.union_all([shapely.LineString([m[:2], m[2:]]) for m in mouths])
    walls = shapely.union_all([shapely.Point(x, y).buffer(r + 0.08) for x, y, r in rows])
    far = shapely.Point(0, 0).buffer(10).difference(shapely.Point(0, 0).buffer(reach - 1e-2))
    assert way.distance(enters) < 1e-9 or way.intersects(walls) or way.intersects(far)


def test_a_closed_room_has_no_mouth_and_a_door_is_one() -> None:
    room = ((-3.0, -3.0), (3.0, -3.0), (3.0, 3.0), (-3.0, 3.0))
    outer = tuple((1.2 * x, 1.2 * y) for x, y in room)
    walls = Obstacle(polygon=outer, holes=(room,))
    spec = Lidar(range_m=9.0, fov_deg=360, beams=720)
    _, mouths = reach_and_mouths(LidarSensor([walls], spec).scan((0.5, 0.2), 0.0), 0.15)
    assert mouths.shape == (0, 4)
    door = Obstacle(polygon=((-3.6, -3.6), (-3.0, -3.6), (-3.0, 3.6), (-3.6, 3.6)))
    ell = Obstacle(polygon=((-3.6, 3.0), (3.6, 3.0), (3.6, 3.6), (-3.6, 3.6)))
    low = Obstacle(polygon=((-3.6, -3.6), (3.6, -3.6), (3.6, -3.0), (-3.6, -3.0)))
    right = Obstacle(polygon=((3.0, -3.6), (3.6, -3.6), (3.6, 1.5), (3.0, 1.5)))
    sensor = LidarSensor([door, ell, low, right], Lidar(range_m=4.5, fov_deg=360, beams=720))
    reach, mouths = reach_and_mouths(sensor.scan((0.0, 0.0), 0.0), 0.15)
    assert reach > 4.49
    assert len(mouths) >= 1
    assert (np.abs(mouths.reshape(-1, 2)).max(axis=1) >= 2.9).all()


def test_a_scan_that_measured_nothing_saw_nothing() -> None:
    blind = Scan((0.0, 0.0), 0.0, -0.5, 0.1, 9.0, np.full(11, np.nan))
    assert reach_and_mouths(blind, 0.2)[0] == 0.0


def test_what_is_outside_of_the_field_of_view_is_no_mouth() -> None:
    wall = Obstacle(polygon=((2.0, -9.0), (3.0, -9.0), (3.0, 9.0), (2.0, 9.0)))
    spec = Lidar(range_m=9.0, fov_deg=90, beams=181)
    assert not len(reach_and_mouths(LidarSensor([wall], spec).scan((0.0, 0.0), 0.0), 0.15)[1])
