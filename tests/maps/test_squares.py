import math
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from viaspline.maps import squares
from viaspline.maps.grid import Grid
from viaspline.maps.squares import blocked_ground, is_unknown, signed_distance

cells = arrays.arrays(bool, st.tuples(st.integers(1, 12), st.integers(1, 12)))
yaws = st.sampled_from([0.0, 0.3, -2.0, math.pi / 2])
places = st.tuples(st.floats(-8, 8), st.floats(-8, 8))


def ground_of(grid: Grid) -> Any:
    """All blocked squares, one by one."""
    boxes = [
        shapely.Polygon(grid.to_world([(c, r), (c + 1, r), (c + 1, r + 1), (c, r + 1)]))
        for r, c in np.argwhere(grid.blocked)
    ]
    return shapely.union_all(boxes, grid_size=1e-9)


@settings(deadline=None, max_examples=300)
@given(blocked=cells, yaw=yaws, place=places, reach=st.floats(0, 9))
def test_the_distance_is_exact_to_the_squares(
    blocked: Any, yaw: float, place: tuple[float, float], reach: float
) -> None:
    grid = Grid(blocked, 0.7, (-3, -2, yaw))
    ground, point = ground_of(grid), shapely.Point(place)
    outside = math.inf if ground.is_empty else ground.distance(point)
    found = signed_distance(grid, place, reach)
    if outside > 1e-7:
        expected = outside if outside <= reach else math.inf
        assert found == pytest.approx(expected, abs=1e-7) or abs(outside - reach) < 1e-7
    else:
        assert found == pytest.approx(-ground.boundary.distance(point), abs=1e-6)


@pytest.mark.parametrize("place", [(0, 0), (3, 1), (1.5, 3), (3, 3)])
def test_on_the_edge_of_the_ground_the_distance_is_nothing(place: tuple[float, float]) -> None:
    assert signed_distance(Grid(np.ones((3, 3)), 1.0), place, 0.0) == 0
    assert signed_distance(Grid(np.ones((3, 3)), 1.0), place, 5.0) == 0


def test_deep_inside_of_a_large_map_the_way_out_is_found() -> None:
    blocked = np.ones((500, 700), bool)
    blocked[20, 650] = False
    grid = Grid(blocked, 0.1)
    assert signed_distance(grid, (40.05, 20.05), 1) == pytest.approx(-20.05)
    assert signed_distance(grid, (65.05, 6.05), 1) == pytest.approx(-3.95)


def test_a_place_is_unknown_in_unknown_squares_only() -> None:
    unknown = np.array([[False, True], [False, False]])
    grid = Grid(np.ones((2, 2)), 1.0, (5, 5, 0), unknown=unknown)
    asked = [(6.5, 5.5), (5.5, 5.5), (6.5, 6.5), (7.5, 5.5), (4, 4)]
    assert [is_unknown(grid, place) for place in asked] == [True, False, False, False, False]
    assert not is_unknown(Grid(np.ones((2, 2)), 1.0), (0.5, 0.5))


@settings(deadline=None)
@given(blocked=cells, yaw=yaws, corner=places, size=st.floats(0.1, 9), fine=st.integers(1, 12))
def test_the_ground_in_a_box_is_all_of_it_and_drawn_coarser_never_less(
    blocked: Any, yaw: float, corner: tuple[float, float], size: float, fine: int
) -> None:
    grid = Grid(blocked, 0.7, (-3, -2, yaw))
    x, y = corner
    box = (x, y, x + size, y + size)
    window = shapely.box(*box)
    inside = shapely.intersection(ground_of(grid), window)
    drawn = blocked_ground(grid, box)
    assert shapely.symmetric_difference(shapely.intersection(drawn, window), inside).area < 1e-6
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(squares, "MOST_CELLS_DRAWN", fine)
        coarse = blocked_ground(grid, box)
    assert shapely.difference(inside, coarse).area < 1e-6
