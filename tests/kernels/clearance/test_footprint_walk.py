"""The body's kernels on small sizes, so that they run with the JIT off as well."""

import math
import os

import numpy as np
import pytest
import shapely

from viaspline.kernels.clearance import footprint_motion as pieces
from viaspline.kernels.clearance import footprint_walk as kernels
from viaspline.kernels.clearance.footprint_pose import body_distances
from viaspline.kernels.curve.curvature_bound import corners, curvature_bounds
from viaspline.kernels.curve.self_intersection import self_loops
from viaspline.maps.grid import Grid
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.world import World

CAR = np.array([(-1, -0.5), (3, -0.5), (3, 0.5), (-1, 0.5)], float)
BEND = np.array([[(0, 0), (4, 0), (8, 1), (9, 5)], [(9, 5), (9, 8), (9, 11), (12, 12)]], float)


def place(spans, w):
    """Positions and headings on one span."""
    basis = np.array([(1 - w) ** 3, 3 * w * (1 - w) ** 2, 3 * w**2 * (1 - w), w**3])
    speed = np.array([(1 - w) ** 2, 2 * w * (1 - w), w * w])
    v = speed.T @ np.diff(spans, axis=0)
    return basis.T @ spans, np.arctan2(v[:, 1], v[:, 0])


def world():
    blocked = np.zeros((4, 3), bool)
    blocked[1, 1] = True
    return World(
        [
            Obstacle(circle={"center": (6, 4), "radius": 1.0}),
            Obstacle(polygon=[(12, 4), (15, 4), (14, 7)]),
            Obstacle(grid=Grid(blocked, 0.5, (3.0, -3.5, 0.4))),
        ],
        bounds=(-9, -9, 20, 20),
    )


def test_bounds_close_in_on_the_least_distance_of_dense_poses():
    packed = world().packed
    at, heading = zip(*(place(span, np.linspace(0, 1, 60)) for span in BEND), strict=True)
    poses = np.column_stack((np.concatenate(at), np.concatenate(heading)))
    least = body_distances(packed, poses, CAR)[0].min()
    lower, upper, _, _, index, (x, y, _) = kernels.body_tightest(packed, BEND, CAR, math.nan, 0.01)
    assert lower <= upper <= lower + 0.01 + 1e-12
    assert lower <= least <= lower + 0.05
    assert index == 0
    assert math.hypot(x - 6, y - 4) - 1 == pytest.approx(upper)


def test_conflicts_are_told_span_by_span():
    packed = world().packed
    lower, upper, span, *_ = kernels.body_tightest(packed, BEND, CAR, math.nan, 0.01)
    clear = kernels.body_conflicts(packed, BEND, CAR, math.nan, lower - 0.01)
    assert clear.tolist() == [-1, -1]
    assert kernels.body_conflicts(packed, BEND, CAR, math.nan, upper + 0.01)[span] == 0


def test_a_turn_from_another_heading_counts_to_the_first_span():
    post = World([Obstacle(circle={"center": (-1.5, 1.5), "radius": 0.2})]).packed
    assert kernels.body_conflicts(post, BEND, CAR, math.nan, 0.1).tolist() == [-1, -1]
    assert kernels.body_conflicts(post, BEND, CAR, 3.0, 0.1).tolist() == [0, -1]


def test_what_a_body_encloses_is_no_free_space():
    pebble = World([Obstacle(circle={"center": (1.0, 0.1), "radius": 0.01})]).packed
    lower, *_ = kernels.body_tightest(pebble, BEND, CAR, math.nan, 0.01)
    assert lower == pytest.approx(-0.4)
    assert kernels.body_conflicts(pebble, BEND, CAR, math.nan, 0.0)[0] == 0


@pytest.mark.skipif(
    os.environ.get("NUMBA_DISABLE_JIT") != "1",
    reason="parts of kernels run by themselves as Python",
)
@pytest.mark.parametrize("seed", range(8))
def test_the_hull_of_four_places_misses_no_more_than_it_says(seed):
    rng = np.random.default_rng(seed)
    stack = np.empty((60, pieces.MOTION_COLUMNS))
    spans = rng.uniform(0, 10, (1, 4, 2))
    assert pieces.load_path(stack, spans, 0, 0)
    body = rng.uniform(-3, 3, (2, 2))
    top = 0
    seen = 0
    while top >= 0 and seen < 40:
        row = stack[top].copy()
        settled = pieces.settle(row)
        if not settled or row[pieces.TO] - row[pieces.FROM] > 0.2:
            if row[pieces.TO] - row[pieces.FROM] < 1e-4:
                break
            pieces.halve_motion(stack, top)
            top += 1
            continue
        top -= 1
        seen += 1
        w = np.linspace(row[pieces.FROM], row[pieces.TO], 41)
        at, heading = place(spans[0], w)
        c, s = np.cos(heading), np.sin(heading)
        ends = [(row[pieces.COS0], row[pieces.SIN0]), (row[pieces.COS1], row[pieces.SIN1])]
        np.testing.assert_allclose(ends, [(c[0], s[0]), (c[-1], s[-1])], atol=1e-9)
        where = [np.column_stack((c * x - s * y, s * x + c * y)) + at for x, y in body]
        hull = shapely.MultiPoint([p for one in where for p in (one[0], one[-1])]).convex_hull
        for (x, y), one in zip(body, where, strict=True):
            missed = row[pieces.SAG] + math.hypot(x, y) * row[pieces.SWING]
            assert shapely.distance(hull, shapely.points(one)).max() <= missed + 1e-9
    assert seen > 0


def test_curvature_is_bounded_and_corners_and_loops_are_told():
    loop = np.array([[(0, 0), (9, 9), (-6, 9), (3, 0)], [(3, 0), (4, 0), (5, 0), (6, 0)]], float)
    assert self_loops(loop).tolist() == [True, False]
    upper, attained, _ = curvature_bounds(BEND, 0.0)
    w = np.linspace(0, 1, 500)
    for k in range(2):
        at, heading = place(BEND[k], w)
        step = np.hypot(*np.diff(at, axis=0).T)
        assert (np.abs(np.diff(heading)) / step).max() <= upper[k] * 1.001
        assert attained[k] <= upper[k] <= attained[k] * (1 + 2e-6)
    assert curvature_bounds(BEND, 5.0)[0].tolist() == [5.0, 5.0]
    assert corners(BEND, False) == pytest.approx([0, math.atan2(1, 4), 0])
