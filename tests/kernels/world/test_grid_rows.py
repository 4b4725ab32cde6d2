"""Grids against shapely's union of their squares, and against the definition; JIT on and off."""

import math
from typing import Any

import numba
import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from viaspline.kernels.clearance.disc import conflicts
from viaspline.kernels.world import grid_rows as grid_kernels
from viaspline.kernels.world.clusters import group_labels
from viaspline.kernels.world.distance import distances, obstacle_distances
from viaspline.kernels.world.grid_rows import NO_COLUMN, row_tables
from viaspline.kernels.world.packed import PackedWorld
from viaspline.kernels.world.segment import mark_near_segment, segment_distance
from viaspline.maps.grid import Grid
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.world.pack import pack

Floats = NDArray[np.float64]


@st.composite
def grids(draw: st.DrawFn, most: int = 9) -> Grid:
    """Small grids of any fill, side, place and yaw."""
    shape = (draw(st.integers(1, most)), draw(st.integers(1, most)))
    rng = np.random.default_rng(draw(st.integers(0, 10_000)))
    blocked = rng.random(shape) < draw(st.sampled_from([0.0, 0.1, 0.4, 0.8, 1.0]))
    side = draw(st.sampled_from([0.05, 1 / 3, 1.0, 2.5]))
    yaw = draw(st.sampled_from([0.0, 0.3, math.pi / 2, -2.1, math.pi]))
    return Grid(blocked, side, (*rng.uniform(-50, 50, 2).tolist(), yaw))


def places(grid: Grid, seed: int, count: int) -> Floats:
    """Columns and rows in and around a grid, many of them on lines and corners of the lattice."""
    rng = np.random.default_rng(seed)
    found = rng.uniform(-3.0, np.array([grid.width, grid.height]) + 3.0, (count, 2))
    return np.where(rng.random((count, 2)) < 0.3, np.round(found), found)


def squares(grid: Grid) -> Any:
    """The blocked cells as one shape, in columns and rows."""
    rows, columns = np.nonzero(grid.blocked)
    return shapely.union_all(shapely.box(columns, rows, columns + 1, rows + 1))


def in_world(grid: Grid) -> Any:
    """The same in metres."""
    return shapely.transform(squares(grid), grid.to_world)


def world(*shapes: Grid | Obstacle) -> PackedWorld:
    return pack(
        [Obstacle(grid=shape) if isinstance(shape, Grid) else shape for shape in shapes], None, ()
    )


def disc(x: float, y: float, radius: float) -> Obstacle:
    return Obstacle(circle={"center": (x, y), "radius": radius})


def to_points(grid: Grid, points: Any) -> Floats:
    distance: Floats = distances(world(grid), np.array(points, float).reshape(-1, 2))[0]
    return distance


def to_segment(packed: PackedWorld, a: Any, b: Any, limit: float = np.inf) -> float:
    (ax, ay), (bx, by) = a, b
    return float(segment_distance(packed, float(ax), float(ay), float(bx), float(by), limit)[0])


# Tables


@given(grids())
def test_tables_count_the_columns_to_where_a_row_changes(grid: Grid) -> None:
    to_right, to_left = (table.reshape(grid.blocked.shape) for table in row_tables(grid.blocked))
    for (row, column), kind in np.ndenumerate(grid.blocked):
        other = np.flatnonzero(grid.blocked[row] != kind) - column
        right, left = other[other > 0], -other[other < 0]
        none = -NO_COLUMN - 1 if kind else NO_COLUMN
        sign = -1 if kind else 1
        assert to_right[row, column] == (sign * right.min() if right.size else none)
        assert to_left[row, column] == (sign * left.min() if left.size else none)


def test_tables_of_the_widest_grid_have_room_for_its_columns() -> None:
    blocked = np.zeros((1, 32_000), bool)
    blocked[0, -1] = True
    to_right, to_left = row_tables(blocked)
    assert (to_right[0], to_right[-1]) == (31_999, -NO_COLUMN - 1)
    assert (to_left[0], to_left[-2], to_left[-1]) == (NO_COLUMN, NO_COLUMN, -1)
    grid = Grid(blocked, 1.0)
    assert to_points(grid, [(0.0, 0.5), (-5.0, 0.5), (31_999.5, 0.5)]).tolist() == [
        31_999.0, 32_004.0, -0.5,
    ]  # fmt: skip


# Points


@given(grids(), st.integers(0, 10_000))
def test_the_signed_distance_is_that_of_the_union_of_the_squares(grid: Grid, seed: int) -> None:
    cells = places(grid, seed, 60)
    found = to_points(grid, grid.to_world(cells))
    union, points = squares(grid), shapely.points(cells)
    if union.is_empty:
        assert np.isinf(found).all()
        return
    depth = shapely.distance(union.boundary, points)
    outside = shapely.distance(union, points)
    expected = np.where(shapely.covers(union, points), -depth, outside) * grid.resolution
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12)


@given(grids(), st.integers(0, 10_000))
def test_the_signed_distance_is_lipschitz_across_every_line_of_the_lattice(
    grid: Grid, seed: int
) -> None:
    here = grid.to_world(places(grid, seed, 60))
    rng = np.random.default_rng(seed)
    there = here + rng.normal(0, 1, here.shape) * 10.0 ** rng.uniform(-15, 1, (len(here), 1))
    first, second = to_points(grid, here), to_points(grid, there)
    if np.isfinite(first).all():
        apart = np.linalg.norm(here - there, axis=1)
        assert (np.abs(first - second) <= apart + 1e-12).all()


def test_on_a_lattice_of_whole_numbers_nothing_is_rounded() -> None:
    blocked = np.array([[0, 0, 0, 0, 0], [0, 1, 1, 1, 0], [0, 1, 1, 1, 0], [0, 1, 1, 1, 0]], bool)
    grid = Grid(blocked, 1.0)
    at = [(1, 1), (4, 2), (2, 2), (2.5, 2.5), (2.5, 4), (0, 0), (5, 1), (2.5, 5.5), (1, 2.5)]
    assert np.abs(to_points(grid, at[:5])).tolist() == [0.0, 0.0, 1.0, 1.5, 0.0]
    assert to_points(grid, at).tolist() == [0, 0, -1, -1.5, 0, math.sqrt(2), 1, 1.5, 0]


def test_where_two_blocked_cells_touch_by_a_corner_nothing_is_free() -> None:
    grid = Grid(np.eye(2, dtype=bool), 1.0)
    assert to_points(grid, [(1, 1), (0.75, 1.25), (1.5, 1.5)]).tolist() == [0.0, 0.25, -0.5]


@given(grids())
def test_outside_of_its_rectangle_a_grid_is_free(grid: Grid) -> None:
    full = Grid(np.ones(grid.blocked.shape, bool), grid.resolution, grid.origin)
    middle = full.to_world([(0.5 * full.width, 0.5 * full.height)])
    depth = 0.5 * full.resolution * min(full.width, full.height)
    np.testing.assert_allclose(to_points(full, middle), -depth)
    assert (to_points(full, full.to_world([(-1, 0.5), (0.5, full.height + 2.0)])) > 0).all()


def test_a_million_metres_away_a_grid_keeps_its_micrometre() -> None:
    grid = Grid(np.eye(5, dtype=bool), 0.1, (1e6, -2e6, 0.3))
    cells = places(grid, 0, 50)
    near = to_points(Grid(grid.blocked, 1.0), cells) * 0.1
    np.testing.assert_allclose(to_points(grid, grid.to_world(cells)), near, atol=2e-9)


def test_a_far_place_is_far_away() -> None:
    grid = Grid(np.ones((2, 2), bool), 1.0)
    np.testing.assert_allclose(to_points(grid, [(1e9, 1.0), (1.0, -1e9)]), [1e9 - 2, 1e9])


# Segments


@given(grids(), st.integers(0, 10_000), st.sampled_from([0.0, 0.3, 2.0, 8.0, np.inf]))
def test_a_segment_has_its_exact_distance_below_the_limit(
    grid: Grid, seed: int, limit: float
) -> None:
    cells = places(grid, seed, 24)
    ends = grid.to_world(cells)
    union, packed = squares(grid), world(grid)
    for k in range(0, 24, 2):
        found = to_segment(packed, ends[k], ends[k + 1], limit * grid.resolution)
        between = np.inf if union.is_empty else shapely.LineString(cells[k : k + 2]).distance(union)
        expected = min(limit, between) * grid.resolution
        assert found == pytest.approx(expected, rel=1e-12, abs=1e-12)
        if limit <= between * (1 - 1e-12):
            assert found == limit * grid.resolution


@pytest.mark.parametrize(
    ("a", "b", "expected"),
    [
        ((-3, 1.5), (9, 1.5), 0.0),  # along the middle of a blocked row
        ((-3, 3), (9, 3), 0.0),  # along its upper side
        ((-3, 3.25), (9, 3.25), 0.25),
        ((0.5, -2), (0.5, 8), 0.5),
        ((4, -2), (4, 8), 0.0),  # along a side, upright
        ((2.2, 1.2), (2.6, 1.4), 0.0),  # within a cell
        ((0, 3), (2, 5), math.sqrt(0.5)),  # past a corner
        ((0, 0), (0, 0), math.sqrt(2)),  # a point
        ((4.5, 1), (9, 1), 0.5),  # starts beside and goes away
        ((0.0, 2.0 - 1e-13), (30, 2.0), 0.0),  # all but level
    ],
)
def test_segments_beside_a_block_by_hand(a: Any, b: Any, expected: float) -> None:
    blocked = np.zeros((5, 6), bool)
    blocked[1:3, 1:4] = True
    for yaw in (0.0, 0.4):
        grid = Grid(blocked, 1.0, (0.0, 0.0, yaw))
        ends = grid.to_world([a, b])
        assert to_segment(world(grid), *ends) == pytest.approx(expected, abs=1e-12)
        assert to_segment(world(grid), *ends[::-1]) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("side", [1.0, 0.1])
def test_a_cell_far_along_a_thousand_kilometres_is_not_missed(side: float) -> None:
    blocked = np.zeros((40, 40), bool)
    blocked[20, 20] = True
    packed = world(Grid(blocked, side, (-20.5 * side, -20.5 * side, 0.0)))
    for angle in np.linspace(0.0, np.pi, 25):
        far = 1e6 * np.array([math.cos(angle), math.sin(angle)])
        assert to_segment(packed, -far, 0.9 * far, 3.0) <= 1e-9
        aside = 2.0 * side * np.array([-math.sin(angle), math.cos(angle)])
        gap = to_segment(packed, aside - far, aside + 0.9 * far)
        reach = 0.5 * side * (abs(math.sin(angle)) + abs(math.cos(angle)))
        assert gap == pytest.approx(2.0 * side - reach, abs=1e-9)


@given(grids(), st.integers(0, 10_000), st.floats(0.01, 5.0))
def test_marking_counts_a_grid_that_is_nearer_than_the_width(
    grid: Grid, seed: int, width: float
) -> None:
    a, b = grid.to_world(places(grid, seed, 2)).tolist()
    packed = world(disc(500.0, 0.0, 1.0), grid)
    found = np.zeros(2, np.bool_)
    gap = to_segment(world(grid), a, b)
    assert mark_near_segment(packed, *a, *b, width, found) == found.sum() == (gap < width)
    assert not found[0]


# Among other obstacles


@given(grids(5), grids(5), st.integers(0, 10_000))
def test_the_nearest_of_grids_and_discs_is_found(first: Grid, second: Grid, seed: int) -> None:
    rng = np.random.default_rng(seed)
    discs = [disc(*rng.uniform(-60, 60, 2).tolist(), 2.0) for _ in range(40)]  # a tree to descend
    packed = world(*discs[:20], first, *discs[20:], second)
    points = np.vstack((rng.uniform(-60, 60, (20, 2)), first.to_world(places(first, seed, 10))))
    distance, index = distances(packed, points)
    alone = np.array([obstacle_distances(packed, i, points) for i in range(42)])
    np.testing.assert_array_equal(distance, alone.min(axis=0))
    np.testing.assert_array_equal(alone[index, range(len(points))], distance)


def near_each_other(packed: PackedWorld, width: float) -> bool:
    labels = group_labels(packed, width)
    return bool(labels[0] == labels[1])


@given(grids(6), grids(6))
def test_two_grids_are_a_group_where_the_gap_is_too_narrow(first: Grid, second: Grid) -> None:
    moved = Grid(second.blocked, second.resolution, (*first.origin[:2], second.origin[2]))
    for other in (moved, second):
        gap = in_world(first).distance(in_world(other))
        for packed in (world(first, other), world(other, first)):
            if not math.isnan(gap):  # of something
                assert near_each_other(packed, gap * (1 + 1e-9) + 1e-9)
            if math.isnan(gap) or gap > 1e-6:
                assert not near_each_other(packed, 1e3 if math.isnan(gap) else 0.999 * gap)


@given(grids(6), st.integers(0, 10_000))
def test_a_grid_and_a_disc_or_polygon_are_a_group_where_the_gap_is_too_narrow(
    grid: Grid, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    centre = np.array(grid.origin[:2]) + rng.normal(0, 5, 2) * grid.resolution
    radius = grid.resolution * 10.0 ** rng.uniform(-1.5, 1)
    angle = np.sort(rng.uniform(0, 2 * np.pi, 5)) + np.arange(5) * 1e-2
    ring = centre + radius * np.column_stack((np.cos(angle), np.sin(angle)))
    shape = in_world(grid)
    if shape.is_empty:
        return
    to_disc = shape.distance(shapely.Point(centre)) - radius
    to_polygon = shape.distance(shapely.Polygon(ring))
    for other, gap in ((disc(*centre, radius), to_disc), (Obstacle(polygon=ring), to_polygon)):
        for packed in (world(grid, other), world(other, grid)):
            assert near_each_other(packed, max(gap, 0.0) * (1 + 1e-9) + 1e-9)
            if gap > 1e-6:
                assert not near_each_other(packed, 0.999 * gap)


def test_what_lies_wholly_inside_of_the_other_is_of_its_group() -> None:
    cell = Grid(np.ones((1, 1), bool), 1.0, (5.0, 5.0, 0.3))
    block = Grid(np.ones((9, 9), bool), 2.0)
    ring = Obstacle(polygon=[(0, 0), (12, 0), (12, 12), (0, 12)])
    hollow = Obstacle(
        polygon=[(0, 0), (12, 0), (12, 12), (0, 12)], holes=([(1, 1), (11, 1), (11, 11), (1, 11)],)
    )
    small = Obstacle(polygon=[(4, 4), (5, 4), (4, 5)])
    for first, second in ((cell, block), (cell, ring), (block, small), (block, disc(5, 5, 0.1))):
        assert near_each_other(world(first, second), 1e-9)
        assert near_each_other(world(second, first), 1e-9)
    assert not near_each_other(world(cell, hollow), 1.0)


def test_groups_join_through_a_grid() -> None:
    wall = np.zeros((3, 50), bool)
    wall[1] = True
    packed = world(disc(1, 4, 1), Grid(wall, 1.0), disc(49, 4, 1), disc(25, 9, 1), disc(25, 11, 1))
    np.testing.assert_array_equal(group_labels(packed, 1.5), [0, 0, 0, 3, 3])
    np.testing.assert_array_equal(group_labels(packed, 0.5), [0, 1, 2, 3, 3])


# Corners


@numba.njit
def _corners_near(
    packed: PackedWorld, x: float, y: float, reach: float, out: Floats, count: int
) -> int:
    return grid_kernels.grid_corners_near(packed, 0, x, y, reach, out, count)


def expected_corners(grid: Grid) -> list[tuple[int, int, int, int]]:
    """Column, row and free direction of every convex corner, by looking at all quadrants."""
    padded = np.pad(grid.blocked, 1)
    found = []
    for row in range(grid.height + 1):
        for column in range(grid.width + 1):
            window = padded[row : row + 2, column : column + 2]
            count = window.sum()
            for r, c in np.ndindex(2, 2):
                alone = count == 1 and window[r, c]
                beside = count == 2 and window[0, 0] == window[1, 1] and window[r, c]
                if alone:
                    found.append((column, row, 1 - 2 * c, 1 - 2 * r))
                elif beside:  # turned by a quarter, both blocked cells become the free ones
                    found.append((column, row, 2 * c - 1, 1 - 2 * r))
    return found


@given(grids(), st.integers(0, 10_000), st.sampled_from([0.4, 2.0, 7.0, 1e3, np.inf]))
def test_corners_within_reach_are_the_convex_ones(grid: Grid, seed: int, far: float) -> None:
    centre = np.random.default_rng(seed).uniform(-2, 10, 2)
    cos, sin = math.cos(grid.origin[2]), math.sin(grid.origin[2])
    expected = []
    for column, row, east, north in expected_corners(grid):
        if math.hypot(column - centre[0], row - centre[1]) <= far:
            x, y = grid.to_world([(column, row)])[0].tolist()
            expected.append(
                (x, y, (cos * east - sin * north) / math.sqrt(2),
                 (sin * east + cos * north) / math.sqrt(2))
            )  # fmt: skip
    (x, y), reach = grid.to_world([centre])[0].tolist(), far * grid.resolution
    room = np.full((len(expected) + 2, 4), np.nan)
    count = _corners_near(world(grid), x, y, reach, room, 1)
    assert count == 1 + len(expected)
    assert np.isnan(room[[0, -1]]).all()
    found = room[1:count]
    expected_rows = np.array(expected).reshape(-1, 4)
    order = np.lexsort(np.round(found, 6).T)
    expected_order = np.lexsort(np.round(expected_rows, 6).T)
    np.testing.assert_allclose(found[order], expected_rows[expected_order], atol=1e-9)
    # too little room: the count tells how much it takes, and no row beyond it is written
    assert _corners_near(world(grid), x, y, reach, room[:1], 1) == count


# Curves


def test_conflicts_tell_which_spans_come_too_close_to_a_grid() -> None:
    blocked = np.zeros((20, 20), bool)
    blocked[12, 9] = True
    straight = np.array([[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0)]])
    spans = np.concatenate([straight + np.array([3.0 * k, 0.0]) for k in range(3)])
    packed = world(Grid(blocked, 0.5, (0.0, -4.5, 0.0)))  # x 4.5 to 5, y 1.5 to 2
    found, where = conflicts(packed, spans, 1.6)
    np.testing.assert_array_equal(found, [-1, 0, -1])
    assert 0.2 < where[1] < 0.8
    clear, _ = conflicts(packed, spans, 1.5 - 1e-7)
    np.testing.assert_array_equal(clear, [-1, -1, -1])
