"""Rounded rings of every kind, discs and capsules and rounded polygons, against shapely."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import shapely
from hypothesis import given
from hypothesis import strategies as st

from viaspline.kernels.clearance.footprint_pose import body_distances
from viaspline.kernels.sensing.raycast import cast
from viaspline.kernels.world.clusters import group_labels
from viaspline.kernels.world.distance import obstacle_distances
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.rasterize import rasterized
from viaspline.kernels.world.segment import segment_distance
from viaspline.mission.shapes.rounded_ring import RoundedRing
from viaspline.world.pack import pack

seeds = st.integers(0, 10_000)
FINE = 256  # segments of a quarter circle: the polygon is inside of the true shape by 2e-5 radii


def random_ring(rng: np.random.Generator) -> RoundedRing:
    """A disc, a capsule, or a star of three to six corners with or without a radius."""
    count = int(rng.integers(1, 7))
    centre = rng.uniform(-8, 8, 2)
    angles = (np.arange(count) + rng.uniform(0, 0.7, count)) * math.tau / count
    reach = rng.uniform(1, 4, count)[:, None]
    corners = centre + reach * np.column_stack((np.cos(angles), np.sin(angles)))
    radius = float(rng.uniform(0.2, 2)) if count < 3 or rng.random() < 0.5 else 0.0
    return RoundedRing([[(x, y) for x, y in corners.tolist()]], radius)


def packed(*rings: RoundedRing) -> PackedWorld:
    obstacles: Any = [SimpleNamespace(ring=ring, grid=None) for ring in rings]
    return pack(obstacles, None, ())


def signed(ring: RoundedRing, points: np.ndarray) -> np.ndarray:
    """Distance less the radius; inside of a polygon's core, below the surface."""
    core = ring.core()
    places = shapely.points(points)
    distance = shapely.distance(core, places)
    if len(ring.loops[0]) > 2:
        inside = shapely.contains(core, places)
        distance = np.where(inside, -shapely.distance(core.exterior, places), distance)
    return np.asarray(distance - ring.radius)


@given(seeds)
def test_the_distance_of_points_is_that_of_the_core_less_the_radius(seed: int) -> None:
    rng = np.random.default_rng(seed)
    ring = random_ring(rng)
    points = rng.uniform(-14, 14, (60, 2))
    found = obstacle_distances(packed(ring), 0, points)
    np.testing.assert_allclose(found, signed(ring, points), atol=1e-9)


@given(seeds)
def test_the_distance_of_segments_is_that_of_the_core_less_the_radius(seed: int) -> None:
    rng = np.random.default_rng(seed)
    ring = random_ring(rng)
    world = packed(ring)
    for a, b in rng.uniform(-14, 14, (20, 2, 2)):
        found, _ = segment_distance(world, *a, *b, np.inf)
        expected = shapely.distance(ring.core(), shapely.LineString([a, b])) - ring.radius
        np.testing.assert_allclose(found, expected, atol=1e-9)
        near, index = segment_distance(world, *a, *b, 1.0)
        assert near == min(found, 1.0)
        assert index == (0 if found < 1.0 else -1)


@given(seeds)
def test_beams_end_where_they_first_meet_the_surface(seed: int) -> None:
    rng = np.random.default_rng(seed)
    ring = random_ring(rng)
    outline = ring.outline(FINE)
    x, y = rng.uniform(-14, 14, 2)
    here = shapely.Point(x, y)
    if outline.distance(here) < 0.1:
        return
    beams, reach = 90, 30.0
    ranges = cast(packed(ring), x, y, 0.1, math.tau / beams, beams, reach)
    for beam, found in enumerate(ranges):
        angle = 0.1 + beam * math.tau / beams
        end = (x + reach * math.cos(angle), y + reach * math.sin(angle))
        hit = shapely.intersection(outline, shapely.LineString([(x, y), end]))
        if hit.is_empty:
            grazing = outline.distance(shapely.LineString([(x, y), end])) < 1e-3
            assert math.isinf(found) or grazing
        elif hit.length > 0.1:  # a beam that grazes a polygon may miss the true arc, or meet it
            assert found <= hit.distance(here) + 1e-9
            assert abs(found - hit.distance(here)) < 0.02


@given(seeds, st.floats(0.01, 6.0))
def test_groups_are_of_those_that_stand_closer_than_a_width(seed: int, width: float) -> None:
    rng = np.random.default_rng(seed)
    first, second = random_ring(rng), random_ring(rng)
    gap = shapely.distance(first.core(), second.core()) - first.radius - second.radius
    if abs(gap - width) < 1e-6:
        return  # the question is a matter of rounding
    labels = group_labels(packed(first, second), width)
    assert (labels[0] == labels[1]) == (gap < width)


@given(seeds)
def test_cells_are_blocked_by_the_distance_of_their_middles(seed: int) -> None:
    rng = np.random.default_rng(seed)
    ring = random_ring(rng)
    side, reach, count = 0.5, float(rng.uniform(0, 1)), 60
    cells = rasterized(
        packed(ring), -15.0, -15.0, side, count, count, reach, np.empty((0, 0), np.uint8)
    )
    rows, columns = np.divmod(np.arange(count * count), count)
    middles = -15.0 + side * (np.column_stack((columns, rows)) + 0.5)
    distance = signed(ring, middles) - reach
    sure = np.abs(distance) > 1e-9
    np.testing.assert_array_equal(cells.ravel()[sure] == 1, distance[sure] < 0)


@given(seeds)
def test_a_body_that_stands_over_something_touches_it(seed: int) -> None:
    rng = np.random.default_rng(seed)
    ring = random_ring(rng)
    body = np.array([(-6, -5), (7, -5), (7, 5), (-6, 5)], np.float64)
    poses = np.column_stack((rng.uniform(-20, 20, (12, 2)), rng.uniform(-4, 4, 12)))
    found, _ = body_distances(packed(ring), poses, body)
    for (x, y, heading), distance in zip(poses, found, strict=True):
        c, s = math.cos(heading), math.sin(heading)
        placed = shapely.Polygon(body @ np.array([[c, s], [-s, c]]) + (x, y))
        expected = max(shapely.distance(placed, ring.core()) - ring.radius, 0.0)
        np.testing.assert_allclose(distance, expected, atol=1e-9)
