"""The world's kernels on small cases worked out by hand; they run with the JIT off as well."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse.csgraph import connected_components

from viaspline.kernels.clearance.disc import STILL, conflicts, tightest
from viaspline.kernels.curve.measure import length_and_curvature
from viaspline.kernels.world.box_tree import box_tree, hilbert_keys, ring_boxes
from viaspline.kernels.world.clusters import group_labels
from viaspline.kernels.world.distance import distances, obstacle_distances
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.rings import EDGES_PER_BLOCK, pack_rings
from viaspline.kernels.world.segment import mark_near_segment, segment_distance
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.pack import join, pack

SQUARE = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)]
STRAIGHT = np.array([[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0)]])


def disc(x: float, y: float, radius: float) -> Obstacle:
    return Obstacle(circle={"center": (x, y), "radius": radius})


def polygon(*ring: tuple[float, float]) -> Obstacle:
    return Obstacle(polygon=ring)


def world(*obstacles: Obstacle, bounds: Any = None, fences: Any = ()) -> PackedWorld:
    return pack(obstacles, bounds, [(ring,) for ring in fences])


def to_segment(packed: PackedWorld, *ends: float, limit: float = np.inf) -> tuple[float, int]:
    distance, index = segment_distance(packed, *map(float, ends), limit)
    return float(distance), int(index)


# Packing


@pytest.mark.parametrize("flip", [1, -1])
@pytest.mark.parametrize("flip_hole", [1, -1])
def test_outer_rings_run_anticlockwise_and_holes_clockwise(flip: int, flip_hole: int) -> None:
    hole = [(1.0, 1.0), (2.0, 1.0), (2.0, 2.0)]
    packed = world(Obstacle(polygon=SQUARE[::flip], holes=(hole[::flip_hole],)))
    for edges, sign in ((packed.edges[:4], 1), (packed.edges[4:], -1)):
        twice = (edges[:, 0] * edges[:, 3] - edges[:, 2] * edges[:, 1]).sum()
        assert np.sign(twice) == sign
        np.testing.assert_array_equal(edges[:, 2:], np.roll(edges[:, :2], -1, axis=0))


@pytest.mark.parametrize("flip", [1, -1])
def test_fences_run_clockwise(flip: int) -> None:
    packed = world(fences=[SQUARE[::flip], [(9.0, 9.0), (8.0, 9.0), (8.0, 8.0)]])
    np.testing.assert_array_equal(packed.fence_edges, [0, 4, 7])
    for first, last in ((0, 4), (4, 7)):
        edges = packed.fences[first:last]
        assert (edges[:, 0] * edges[:, 3] - edges[:, 2] * edges[:, 1]).sum() < 0
        np.testing.assert_array_equal(edges[:, 2:], np.roll(edges[:, :2], -1, axis=0))


@pytest.mark.parametrize(
    "count", [3, EDGES_PER_BLOCK - 1, EDGES_PER_BLOCK, EDGES_PER_BLOCK + 1, 5 * EDGES_PER_BLOCK + 3]
)
def test_blocks_hold_all_edges_once(count: int) -> None:
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    ring = np.column_stack((np.cos(angle), np.sin(angle)))
    edges, ring_blocks, block_edges = pack_rings(
        np.vstack((ring, ring + 9)), np.array([0, count, 2 * count]), np.array([0, 1, 2])
    )
    assert block_edges[0] == 0
    assert block_edges[-1] == len(edges) == 2 * count
    assert (np.diff(block_edges) >= 1).all()
    assert (np.diff(block_edges) <= EDGES_PER_BLOCK).all()
    np.testing.assert_array_equal(block_edges[ring_blocks], [0, count, 2 * count])
    boxes = ring_boxes(edges, block_edges)
    for box, first, last in zip(boxes, block_edges[:-1], block_edges[1:], strict=True):
        xs, ys = edges[first:last, ::2], edges[first:last, 1::2]
        np.testing.assert_array_equal(box, [xs.min(), ys.min(), xs.max(), ys.max()])


@given(st.integers(0, 60), st.integers(0, 1000))
def test_a_tree_holds_every_leaf_once_within_its_ancestors(count: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    low = rng.uniform(-9, 9, (count, 2))
    boxes = np.hstack((low, low + rng.uniform(0, 3, (count, 2))))
    keys = hilbert_keys(boxes)
    assert keys.shape == (count,)
    assert (keys >= 0).all()
    nodes, skip, leaf = box_tree(boxes, np.argsort(keys, kind="stable"))
    assert sorted(leaf[leaf >= 0].tolist()) == list(range(count))
    for node in range(len(leaf)):
        assert node < skip[node] <= len(leaf)
        below = leaf[node : skip[node]]
        inside = boxes[below[below >= 0]]
        np.testing.assert_array_equal(nodes[node, :2], inside[:, :2].min(axis=0))
        np.testing.assert_array_equal(nodes[node, 2:], inside[:, 2:].max(axis=0))
        if leaf[node] >= 0:
            assert skip[node] == node + 1


def test_places_near_on_a_hilbert_curve_are_near_in_the_plane() -> None:
    axis = np.arange(16.0)
    places = np.stack(np.meshgrid(axis, axis), axis=-1).reshape(-1, 2)
    keys = hilbert_keys(np.hstack((places, places)))
    steps = np.diff(places[np.argsort(keys)], axis=0)
    assert len(set(keys.tolist())) == 256
    assert np.abs(steps).sum(axis=1).max() == 1.0


def test_boxes_that_are_all_one_place_have_a_tree_as_well() -> None:
    boxes = np.zeros((9, 4))
    nodes, _, leaf = box_tree(boxes, np.argsort(hilbert_keys(boxes), kind="stable"))
    assert sorted(leaf[leaf >= 0].tolist()) == list(range(9))
    assert not nodes.any()


def test_a_join_with_nothing_is_the_other_one() -> None:
    some, none = world(disc(0, 0, 1), polygon(*SQUARE)), world(bounds=(0, 0, 5, 5))
    assert join(some, world(), 2)[0] is some
    joined, _ = join(none, some, 0)
    np.testing.assert_array_equal(joined.bounds, [[0, 0, 5, 5]])
    np.testing.assert_array_equal(joined.heads, some.heads)


# Distances


def test_points_have_the_signed_distance_of_what_is_nearest() -> None:
    packed = world(disc(-5, 0, 2), polygon(*SQUARE), bounds=(-10, -10, 10, 10))
    distance, index = distances(
        packed, np.array([(-1.0, 0.0), (2.0, 1.0), (9.5, 0.0), (0.0, 11.0)])
    )
    np.testing.assert_allclose(distance, [1, -1, 0.5, -1])
    np.testing.assert_array_equal(index, [1, 1, -2, -2])
    np.testing.assert_allclose(obstacle_distances(packed, 0, np.array([(-5.0, 0.0)])), [-2])


def test_a_segment_has_the_distance_of_what_is_nearest_to_it() -> None:
    packed = world(disc(0, 5, 2), polygon((10, 1), (14, 1), (14, 5), (10, 5)))
    assert to_segment(packed, -9, 0, 9, 0) == (pytest.approx(math.sqrt(2)), 1)
    assert to_segment(packed, -9, 0, 5, 0) == (3.0, 0)
    assert to_segment(packed, 0, 0, 0, 9)[0] == -2.0
    assert to_segment(packed, 9, 3, 15, 3) == (0.0, 1)
    assert to_segment(packed, 11, 3, 12, 3) == (0.0, 1)
    assert to_segment(packed, 50, 50, 60, 50, limit=7.0) == (7.0, -1)


def test_a_segment_inside_a_hole_is_free() -> None:
    ring = Obstacle(
        polygon=[(0, 0), (9, 0), (9, 9), (0, 9)], holes=([(1, 1), (8, 1), (8, 8), (1, 8)],)
    )
    assert to_segment(world(ring), 3, 3, 5, 5) == (2.0, 0)
    assert to_segment(world(ring), 3, 3, 20, 5)[0] == 0.0


def test_a_segment_that_leaves_bounds_or_fence_has_no_distance_left() -> None:
    assert to_segment(world(bounds=(0, 0, 9, 9)), 1, 5, 6, 5) == (1.0, -2)
    assert to_segment(world(bounds=(0, 0, 9, 9)), 1, 5, 11, 5) == (-2.0, -2)
    fence = [(0, 0), (9, 0), (9, 9), (5, 9), (5, 4), (4, 4), (4, 9), (0, 9)]
    assert to_segment(world(fences=[fence]), 1, 2, 8, 2) == (1.0, -3)
    assert to_segment(world(fences=[fence]), 2, 7, 7, 7) == (0.0, -3)
    assert to_segment(world(fences=[fence]), 20, 7, 27, 7)[0] <= 0.0


@given(st.integers(0, 1000))
def test_marking_finds_what_is_nearer_than_the_width(seed: int) -> None:
    rng = np.random.default_rng(seed)
    centres, radii = rng.uniform(0, 30, (25, 2)), rng.uniform(0.1, 2, 25)
    packed = world(*(disc(*c, r) for c, r in zip(centres.tolist(), radii.tolist(), strict=True)))
    a, b = rng.uniform(0, 30, (2, 2))
    width = float(rng.uniform(0.1, 5))
    w = np.clip((centres - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
    gaps = np.linalg.norm(centres - a - w[:, None] * (b - a), axis=1) - radii
    found = np.zeros(25, np.bool_)
    found[3] = True
    expected = gaps < width
    count = mark_near_segment(packed, a[0], a[1], b[0], b[1], width, found)
    assert count == expected.sum() - expected[3]
    expected[3] = True
    np.testing.assert_array_equal(found, expected)


def test_labels_are_the_smallest_index_of_a_group() -> None:
    packed = world(
        disc(9, 0, 1), disc(0, 0, 1), disc(3, 0, 1), polygon((4.5, -1), (5, 0), (4.5, 1))
    )
    np.testing.assert_array_equal(group_labels(packed, 1.5), [0, 1, 1, 1])
    np.testing.assert_array_equal(group_labels(packed, 0.4), [0, 1, 2, 3])
    np.testing.assert_array_equal(group_labels(packed, 9.0), [0, 0, 0, 0])


def test_the_groups_of_a_crowd_are_those_of_all_its_pairs() -> None:
    rng = np.random.default_rng(3)
    middles, radii = rng.uniform(0, 10, (300, 2)), rng.uniform(0, 0.2, 300)
    packed = world(*(disc(*at, r) for at, r in zip(middles.tolist(), radii.tolist(), strict=True)))
    gaps = np.hypot(*np.moveaxis(middles[:, None] - middles, -1, 0)) - radii[:, None] - radii
    counts = []
    for width in (0.05, 0.1, 0.3, 0.6):
        expected = connected_components(gaps < width, directed=False)[1]
        labels = group_labels(packed, width)
        smallest = [np.flatnonzero(expected == group)[0] for group in expected]
        np.testing.assert_array_equal(labels, smallest)
        counts.append(np.unique(labels).size)
    assert counts == sorted(counts, reverse=True)
    assert counts[0] > 100 > 10 > counts[-1]


# Curves


def test_the_tightest_place_of_a_straight_span_is_beside_the_obstacle() -> None:
    lower, upper, span, w, index = tightest(world(disc(1.2, 3, 1)), STRAIGHT, STILL, 1e-6)
    assert 2.0 - 1e-6 <= lower <= 2.0 <= upper <= 2.0 + 1e-6
    assert (span, index) == (0, 0)
    assert w == pytest.approx(0.4, abs=1e-2)


def test_nothing_is_infinitely_far_away() -> None:
    lower, upper, *_, index = tightest(world(), STRAIGHT, STILL, 1e-3)
    assert lower == upper == np.inf
    assert index == -1


def test_conflicts_tell_spans_apart() -> None:
    spans = np.concatenate([STRAIGHT + np.array([3.0 * k, 0.0]) for k in range(3)])
    found, where = conflicts(world(disc(4.5, 1.5, 1), disc(7.5, 9, 1)), spans, 0.6)
    np.testing.assert_array_equal(found, [-1, 0, -1])
    assert 0.2 < where[1] < 0.8
    clear, _ = conflicts(world(disc(4.5, 1.5, 1)), spans, 0.5 - 1e-7)
    np.testing.assert_array_equal(clear, [-1, -1, -1])


def test_conflicts_find_a_wall_between_two_samples() -> None:
    wall = polygon((1.001, -1), (1.0010001, -1), (1.0010001, 1), (1.001, 1))
    found, _ = conflicts(world(wall), STRAIGHT, 1e-5)
    assert found.tolist() == [0]


def test_length_and_curvature_of_a_quarter_circle() -> None:
    k = 4 / 3 * math.tan(math.pi / 8)
    arc = np.array([[(5.0, 0.0), (5.0, 5 * k), (5 * k, 5.0), (0.0, 5.0)]])
    length, sharpest = length_and_curvature(arc)
    assert length == pytest.approx(2.5 * math.pi, rel=5e-4)
    assert sharpest == pytest.approx(0.2, rel=2e-2)
    length, sharpest = length_and_curvature(STRAIGHT)
    assert (length, sharpest) == (pytest.approx(3.0), pytest.approx(0.0))
