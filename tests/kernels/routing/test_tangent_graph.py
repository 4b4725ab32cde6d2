"""Routes, bends and corners on small cases worked out by hand; with the JIT off as well."""

import itertools
import math
from typing import Any

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

from viaspline.kernels.routing.tangent_arcs import SIDE, TURN, bends_of, detour_points, taut_length
from viaspline.kernels.routing.tangent_graph import barrier_crossings, shortest_route
from viaspline.kernels.world.corner_fans import CENTER_X, RADIUS, X, Y
from viaspline.kernels.world.packed import PackedWorld
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.pack import pack

Floats = NDArray[np.float64]
NONE = np.empty((0, 4))
STEP = math.pi / 12
CLOSE, ROUND = np.array([[0.2, 0.0]]), np.array([[0.2, 1e-4]])


def disc(x: float, y: float, radius: float) -> Obstacle:
    return Obstacle(circle={"center": (x, y), "radius": radius})


def world(*obstacles: Obstacle, **frame: Any) -> PackedWorld:
    return pack(obstacles, frame.get("bounds"), [(ring,) for ring in frame.get("fences", ())])


def route(packed: PackedWorld, start: Any, goal: Any, barriers: Floats = NONE) -> Floats:
    active = np.zeros(packed.slot.size, np.bool_)
    return shortest_route(
        packed,
        np.array(start, float),
        np.array(goal, float),
        1.001,
        1.0,
        STEP,
        barriers,
        active,
        100,
    )


def test_a_free_route_has_two_corners_and_no_bend() -> None:
    found = route(world(disc(0, 50, 5)), (-20, 0), (20, 0))
    np.testing.assert_array_equal(found[:, X : Y + 1], [(-20, 0), (20, 0)])
    bends = bends_of(found)
    assert len(bends) == 2
    assert taut_length(found, bends) == 40.0
    assert detour_points(bends, CLOSE.repeat(2, 0))[0].shape == (0, 2)


def test_a_route_round_a_circle_wraps_its_arc() -> None:
    found = route(world(disc(0, -1, 5)), (-20, 0), (20, 0))
    corners = found[1:-1]
    assert (corners[:, Y] > 0).all()
    assert (corners[:, CENTER_X] == 0).all()
    np.testing.assert_allclose(corners[:, RADIUS], 6.001)
    bends = bends_of(found)
    assert len(bends) == 3
    assert bends[1, SIDE] == -1.0
    away = math.hypot(20, 1)
    tangent = math.sqrt(away**2 - 6.001**2)
    turn = 2 * (math.pi / 2 - math.atan2(1, 20)) - 2 * math.acos(6.001 / away)
    assert bends[1, TURN] == pytest.approx(turn)
    assert taut_length(found, bends) == pytest.approx(2 * tangent + 6.001 * turn)


def test_a_barrier_sends_a_route_to_the_other_side() -> None:
    packed = world(disc(0, -1, 5))
    barrier = np.array([[0.0, -1.0, 0.0, 900.0]])
    found = route(packed, (-20, 0), (20, 0), barrier)
    assert (found[1:-1, Y] < 0).all()
    assert barrier_crossings(found, barrier) == (0, -1)
    assert barrier_crossings(found, np.array([[0.0, -1.0, 0.0, -900.0]]))[0] == 1
    assert bends_of(found)[1, SIDE] == 1.0


def test_barriers_on_both_sides_leave_no_route() -> None:
    barriers = np.array([[0.0, -1.0, 0.0, 900.0], [0.0, -1.0, 0.0, -900.0]])
    assert len(route(world(disc(0, -1, 5)), (-20, 0), (20, 0), barriers)) == 0


def test_obstacles_on_the_way_round_become_active() -> None:
    packed = world(disc(0, -1, 5), disc(0, 8, 4), disc(0, 60, 4))
    active = np.zeros(3, np.bool_)
    shortest_route(
        packed, np.array([-20.0, 0.0]), np.array([20.0, 0.0]), 1.001, 1.0, STEP, NONE, active, 100
    )
    assert active.tolist() == [True, True, False]


def test_a_fence_is_turned_at_where_it_is_not_convex() -> None:
    fence = [(0, 0), (60, 0), (60, 20), (20, 20), (20, 60), (0, 60)]
    found = route(world(fences=[fence]), (10, 55), (55, 10))
    assert len(found) > 2
    assert (np.hypot(found[1:-1, X] - 20, found[1:-1, Y] - 20) >= 1.0).all()
    assert (found[1:-1, X : Y + 1] < 20.0).all()


def test_a_polygon_with_a_repeated_vertex_keeps_its_corners() -> None:
    ring = [(-5, -5), (-5, -5), (5, -5), (5, -5), (5, 5), (-5, 5), (-5, 5)]
    found = route(world(Obstacle(polygon=ring)), (-20, 1), (20, 1))
    bends = bends_of(found)
    assert taut_length(found, bends) == pytest.approx(
        10 + 2 * math.sqrt(15**2 + 4**2 - 1.001**2)
        + 2 * 1.001 * (math.atan2(4, 15) + math.asin(1.001 / math.hypot(15, 4))),
    )  # fmt: skip


def test_detour_points_stand_outside_of_the_arc_and_beside_it() -> None:
    found = route(world(disc(0, -1, 5)), (-20, 0), (20, 0))
    bends = bends_of(found)
    points, of = detour_points(bends, CLOSE.repeat(len(bends), 0))
    assert (np.diff(of) >= 0).all()
    away = np.hypot(points[:, 0], points[:, 1] + 1)
    assert (away > 6.001).all()
    assert away.min() < 6.04
    assert (np.diff(points[:, 0]) > 0).all()
    np.testing.assert_allclose(points[:, 0], -points[::-1, 0], atol=1e-9)
    track = np.vstack(((-20, 0), points, (20, 0)))
    for a, b in itertools.pairwise(track):
        w = np.linspace(0, 1, 50)[:, None]
        between = a + w * (b - a)
        assert np.hypot(between[:, 0], between[:, 1] + 1).min() >= 6.0


def test_a_bend_that_turns_by_less_than_nothing_is_one_point() -> None:
    """As they came of a depot's squares in a row: rounding left turns of -1e-14."""
    bends = np.array(
        [
            [27.177129, 9.556953, 0.0, 0.0, 0.0, 0.0],
            [26.990247, 9.112223, 0.337, 1.0, -1.681454, 2e-15],
            [26.918832, 8.46949, 0.337, 1.0, -1.681454, -1.3e-14],
            [26.905321, 8.347888, 0.337, 1.0, -1.681454, 2.015342],
            [27.528087, 8.207211, 0.0, 0.0, 0.333888, 0.0],
        ]
    )
    assert np.isfinite(detour_points(bends, ROUND.repeat(len(bends), 0))[0]).all()


def test_a_corner_on_one_line_with_others_is_wrapped_on_the_side_it_points_away_from() -> None:
    """Rounding made a right turn of it, as if the walls that stand to the left stood there."""
    far, half = 1 / math.cos(math.radians(15)), math.tan(math.radians(15))
    fan = [(0, -75), (0, -45), (0, -15), (1, 15), (2, 15), (2, 45), (2, 75)]
    normals = [(y, math.cos(math.radians(deg)), math.sin(math.radians(deg))) for y, deg in fan]
    rows = [(1 + far * nx, y + far * ny, 1, y, 1, nx, ny, half) for y, nx, ny in normals]
    found = np.array([(0, -1, *6 * [0]), *rows, (0, 3, *6 * [0])], float)
    found[3:6, X] = 2.0
    bends = bends_of(found)
    assert (bends[1:-1, SIDE] == 1.0).all()
    points, _ = detour_points(bends, CLOSE.repeat(len(bends), 0))
    assert shapely.LineString(points).distance(shapely.box(0, 0, 1, 2)) > 1.0 - 1e-12
