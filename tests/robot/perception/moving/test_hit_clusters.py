"""Clusters part the hits of a scan, and a disc that is seen is a disc."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from viaspline.mission.sensor_spec import Lidar
from viaspline.mission.shapes.circle import Circle
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.perception.lidar import LidarSensor, Scan
from viaspline.robot.perception.moving.hit_clusters import clusters_of

FULL = Lidar(range_m=10.0, fov_deg=360, beams=1440)


@given(st.lists(st.one_of(st.none(), st.floats(0.5, 9)), min_size=3, max_size=60),
       st.booleans(), st.randoms(use_true_random=False))  # fmt: skip
def test_every_chosen_hit_is_in_one_cluster_and_in_its_disc(
    ranges: list[float | None], full: bool, rng: object
) -> None:
    lengths = np.array([np.inf if value is None else value for value in ranges])
    step = math.tau / len(ranges) if full else 0.01
    scan = Scan((0.3, -0.2), 0.4, -0.2, step, 9.5, lengths)
    chosen = np.array([rng.random() < 0.8 for _ in scan.hits], np.bool_)  # type: ignore[attr-defined]
    clusters = clusters_of(scan, chosen)
    found = [hit for cluster in clusters for hit in cluster.hits.tolist()]
    assert sorted(found) == np.flatnonzero(chosen).tolist()
    for cluster in clusters:
        away = np.hypot(*(cluster.points - cluster.center).T)
        assert away.max() <= cluster.radius + 1e-9


@given(st.floats(1.5, 6.0), st.floats(-math.pi, math.pi), st.floats(0.2, 0.6))
def test_a_disc_is_one_cluster_with_its_middle_and_radius(
    away: float, bearing: float, radius: float
) -> None:
    """Also where it lies across the first and the last beam of a full turn."""
    center = (away * math.cos(bearing), away * math.sin(bearing))
    post = Obstacle(circle=Circle(center=center, radius=radius))
    scan = LidarSensor([post], FULL).scan((0.0, 0.0), 0.0)
    [cluster] = clusters_of(scan, np.full(len(scan.hits), True))
    spacing = away * scan.angle_increment
    assert not cluster.is_cut
    assert math.dist(cluster.center, center) < 2.0 * spacing
    assert abs(cluster.radius - radius) < 3.0 * spacing


def test_what_is_partly_hidden_or_at_the_edge_of_the_view_is_cut() -> None:
    post = Obstacle(circle=Circle(center=(4.0, 0.0), radius=0.5))
    screen = Obstacle(circle=Circle(center=(2.0, 0.3), radius=0.2))
    scan = LidarSensor([post, screen], FULL).scan((0.0, 0.0), 0.0)
    clusters = clusters_of(scan, np.full(len(scan.hits), True))
    assert [c.is_cut for c in clusters if np.hypot(*c.center) > 3.0] == [True]
    assert [c.is_cut for c in clusters if np.hypot(*c.center) < 3.0] == [False]
    narrow = Lidar(range_m=10.0, fov_deg=10, beams=41)
    scan = LidarSensor([post], narrow).scan((0.0, 0.0), 0.05)
    assert [c.is_cut for c in clusters_of(scan, np.full(len(scan.hits), True))] == [True]
