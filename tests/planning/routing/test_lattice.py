"""Lattices of worlds with maps: what they must not leave out."""

import re
from typing import Any

import numpy as np
import pytest

import viaspline as vs
from viaspline.maps.grid import Grid
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.routing.lattices import MAX_ON_MAP_LINES, fine_lattice
from viaspline.planning.routing.route_problem import NO_BARRIERS
from viaspline.planning.routing.router import Router
from viaspline.planning.routing.taut_path import TautPath
from viaspline.world.world import World

WALL = np.ones((1, 4), bool)


def taut_path(world: World, start: Any, goal: Any, required: float = 0.2) -> TautPath | None:
    places = np.array([start, goal], float)
    active = np.zeros(len(world), np.bool_)
    return Router(world, required, places).find(*places, NO_BARRIERS, active).value


def wall(yaw: float = 0.0) -> Obstacle:
    """Four blocked cells of 1 m in a row from (0, 0) on."""
    return Obstacle(grid=Grid(WALL, 1.0, (0.0, 0.0, yaw)))


@pytest.mark.parametrize("bounds", [None, (-3, -3, 6, 6), (-3.5, -3.25, 6.1, 6.7)])
@pytest.mark.parametrize("yaw", [0.0, 0.1])
def test_a_map_may_be_left_and_gone_round(bounds: Any, yaw: float) -> None:
    found = taut_path(World([wall(yaw)], bounds=bounds), (2, -2), (2, 3))
    assert found is not None
    assert 5.0 < found.length < 9.0


@pytest.mark.parametrize("bounds", [(0, -3, 4, 6), (-0.3, -3, 4.3, 6)])
def test_nothing_leads_round_a_map_where_the_bounds_are_too_near(bounds: Any) -> None:
    assert taut_path(World([wall()], bounds=bounds), (2, -2), (2, 3)) is None


def test_a_fence_on_a_map_is_kept_to() -> None:
    room = Obstacle(grid=Grid(np.zeros((9, 9), bool), 1.0, (0.0, 0.0, 0.0)))
    fence = [(0, 0), (9, 0), (9, 9), (6, 9), (6, 3), (3, 3), (3, 9), (0, 9)]
    found = taut_path(World([room], fences=[fence]), (1.5, 8), (7.5, 8))
    assert found is not None
    assert found.length > 12.0
    assert taut_path(World([room], fences=[fence]), (1.5, 8), (4.5, 8)) is None


@pytest.mark.parametrize("side", [60.0, 3_000.0, 20_000.0])
def test_wide_bounds_about_a_small_map_take_no_more_cells_than_fit_in_memory(side: float) -> None:
    """The map's cells of 5 cm aren't those of what lies about it."""
    middle = 0.5 * side
    room = Obstacle(grid=Grid(np.ones((20, 20), bool), 0.05, (middle, middle, 0.0)))
    ends = np.array([(0.1 * side, 0.1 * side), (0.9 * side, 0.9 * side)])
    router = Router(World([room], bounds=(0.0, 0.0, side, side)), 0.5, ends)
    sizes = [lattice.cells.size for lattice in router.ever_finer()]
    assert max(sizes) <= MAX_ON_MAP_LINES
    found = router.find(*ends, NO_BARRIERS, np.zeros(1, np.bool_)).value
    assert found is not None
    assert found.length == pytest.approx(np.hypot(*(ends[1] - ends[0])), rel=1e-3)


@pytest.mark.parametrize(
    ("required", "side"), [(0.05, None), (0.1, 0.05), (0.4, 0.1), (0.8, 0.2), (9.0, 1.0)]
)
def test_fine_cells_on_a_map_are_open_and_on_its_lines_or_none(
    required: float, side: float | None
) -> None:
    room = World([Obstacle(grid=Grid(np.zeros((200, 200), bool), 1.0, (0.0, 0.0, 0.0)))])
    found = fine_lattice(room, required, required, np.array([(50.0, 50.0), (150.0, 150.0)]))
    assert (None if found is None else found.side) == side
    assert found is None or found.kept < required


@pytest.mark.parametrize(("required", "side"), [(2.0, 0.5), (0.01, 0.1)])
def test_fine_cells_without_a_map_are_as_fine_as_so_many_allow(
    required: float, side: float
) -> None:
    room = World([Obstacle(circle={"center": (50, 50), "radius": 3})], bounds=(0, 0, 100, 100))
    found = fine_lattice(room, required, required, np.array([(9.0, 9.0), (90.0, 90.0)]), 1_000_000)
    assert found is not None
    assert found.side == pytest.approx(side)
    assert (found.kept < required) == (required == 2.0)


def test_a_place_is_free_where_its_cell_is_and_not_off_the_lattice() -> None:
    made = Router(World([wall()], bounds=(-2, -2, 6, 3)), 0.2, np.array([(-1.0, -1.0)])).lattice
    places = ((-1.0, -1.0), (2.0, 0.5), (-9.0, 0.0), (99.0, 0.0))
    assert [made.is_free(np.array(at)) for at in places] == [True, False, False, False]


def test_a_way_to_where_one_is_has_no_length() -> None:
    found = taut_path(World([wall()]), (2, -2), (2, -2))
    assert found is not None
    assert found.length == 0.0


def test_a_refusal_tells_widths_apart_that_are_the_same_to_the_millimetre():
    walls = [(-9, 0.29998, -8.5, 40), (-9, -40, -8.5, -0.29998)]
    known = [{"polygon": [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]} for x0, y0, x1, y1 in walls]
    data = {
        "world": {"known": known, "bounds": [-20, -20, 20, 20]},
        "robot": {"radius_m": 0.3, "clearance_m": 0},
        "route": {"start": [-15, 0], "goal": [10, 0]},
    }
    with pytest.raises(vs.NoPathError) as refused:
        vs.plan(vs.Mission.model_validate(data))
    room, needed = re.findall(r"(\d\.\d+) m", refused.value.reason)
    assert float(room) == pytest.approx(0.59996, abs=2e-5)
    assert float(room) < float(needed) == 0.6
