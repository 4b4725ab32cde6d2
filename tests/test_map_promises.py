"""The promises on maps: found where there is a way, refused with a remedy that serves where not."""

from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy import ndimage

import viaspline as vs
from viaspline.mission.shapes.obstacle import Obstacle

seeds = st.integers(0, 100_000)
FINE = 6  # lattice points of the oracle along the side of a cell


def random_cells(rng: np.random.Generator) -> Any:
    height, width = rng.integers(4, 18, 2)
    if rng.random() < 0.4:
        return ndimage.binary_dilation(rng.random((height, width)) < 0.06, iterations=2)
    return rng.random((height, width)) < rng.uniform(0.05, 0.4)


def brute_distance(cells: Any, side: float, x: Any, y: Any) -> Any:
    """Distance of places to blocked squares and to the map's edge, square by square."""
    height, width = cells.shape
    best = np.minimum(np.minimum(x, width * side - x), np.minimum(y, height * side - y))
    for row, column in np.argwhere(cells):
        dx = np.maximum(np.maximum(column * side - x, x - (column + 1) * side), 0.0)
        dy = np.maximum(np.maximum(row * side - y, y - (row + 1) * side), 0.0)
        best = np.minimum(best, np.hypot(dx, dy))
    return best


def flood_fill(cells: Any, side: float, required: float, start: Any, goal: Any) -> tuple[Any, Any]:
    """Whether there surely is a way, and whether there may be one."""
    step = side / FINE
    height, width = (count * FINE for count in cells.shape)
    x, y = np.meshgrid((np.arange(width) + 0.5) * step, (np.arange(height) + 0.5) * step)
    room = brute_distance(cells, side, x, y)
    slip = step * np.sqrt(0.5)
    ends = [(int(place[1] / step), int(place[0] / step)) for place in (start, goal)]
    answers = []
    for wanted in (required + 2 * slip, required - slip):
        rooms, _ = ndimage.label(room >= wanted, np.ones((3, 3)))
        answers.append(rooms[ends[0]] > 0 and rooms[ends[0]] == rooms[ends[1]])
    return answers[0], answers[1]


def task(seed: int) -> tuple[Any, float, float, Any, Any]:
    rng = np.random.default_rng(seed)
    cells, side = random_cells(rng), float(rng.choice([0.05, 0.37, 1.0]))
    required = side * float(rng.choice([0.1, 0.3, 0.45, 0.5, 0.8, 1.0, 1.3, 2.0]))
    height, width = cells.shape
    places = rng.uniform((0, 0), (width * side, height * side), (300, 2))
    places = places[brute_distance(cells, side, *places.T) > 1.001 * required]
    assume(len(places) > 1)
    return cells, side, required, places[0], places[1]


def mission(
    cells: Any, side: float, start: Any, goal: Any, radius: float, clearance: float = 0.0
) -> vs.Mission:
    obstacle = Obstacle(grid=vs.Grid(cells, side), name="map")
    return vs.Mission.model_validate(
        {
            "world": {"known": [obstacle], "bounds": obstacle.grid.extent},
            "robot": {"radius_m": radius, "clearance_m": clearance},
            "route": {"start": start, "goal": goal},
        }
    )


def found(asked: vs.Mission) -> bool:
    try:
        return vs.plan(asked).certificate.holds
    except vs.PlanningError:
        return False


@settings(max_examples=60)
@given(seeds)
def test_a_way_through_a_map_is_found_where_there_is_one_and_only_there(seed: int) -> None:
    cells, side, required, start, goal = task(seed)
    surely, maybe = flood_fill(cells, side, required, start, goal)
    way = found(mission(cells, side, start, goal, required))
    assert way or not surely
    assert maybe or not way


@settings(max_examples=40)
@given(seeds)
def test_no_place_of_the_curve_is_nearer_to_a_square_than_its_certificate_says(seed: int) -> None:
    cells, side, required, start, goal = task(seed)
    try:
        plan = vs.plan(mission(cells, side, start, goal, 0.5 * required, 0.5 * required))
    except vs.PlanningError:
        return
    along = np.asarray(plan.path.at_distance(np.linspace(0.0, plan.path.length, 2000)))
    nearest = brute_distance(cells, side, *along.T).min() - 0.5 * required
    assert nearest >= plan.certificate.clearance - 1e-9
    assert plan.certificate.clearance >= 0.5 * required - 2e-6
    assert along[0] == pytest.approx(start)
    assert along[-1] == pytest.approx(goal)


@settings(max_examples=40)
@given(seeds)
def test_a_remedy_that_is_offered_serves(seed: int) -> None:
    cells, side, required, start, goal = task(seed)
    asked = mission(cells, side, start, goal, 0.2 * required, 0.8 * required)
    try:
        vs.plan(asked)
    except vs.PlanningError as error:
        for remedy in error.remedy.split(" or "):
            if remedy.startswith("set robot.clearance_m to at most "):
                smaller = float(remedy.rsplit(" ", 1)[1])
                assert found(mission(cells, side, start, goal, 0.2 * required, smaller))
            if remedy.startswith("move 'goal' to ("):
                place = [float(part) for part in remedy[16:-1].split(",")]
                assert found(mission(cells, side, start, place, 0.2 * required, 0.8 * required))


def test_the_gap_that_is_too_narrow_is_named_with_its_place_and_width() -> None:
    cells = np.zeros((20, 30), bool)
    cells[:, 15] = True
    cells[9:12, 15] = False
    wall = mission(cells, 0.1, (0.5, 0.5), (2.5, 0.5), 0.1, 0.06)
    with pytest.raises(
        vs.NoPathError, match=r"with 0\.300 m of room, 0\.320 m are needed"
    ) as caught:
        vs.plan(wall)
    assert caught.value.where == pytest.approx((1.55, 1.05), abs=0.15)
    assert "set robot.clearance_m to at most 0.048" in caught.value.remedy


def test_a_pocket_that_nothing_connects_is_said_to_be_shut_off() -> None:
    cells = np.zeros((40, 40), bool)
    cells[10:30, (10, 29)] = True
    cells[(10, 29), 10:30] = True
    with pytest.raises(vs.NoPathError, match="nothing leads from 'start' to 'goal'") as caught:
        vs.plan(mission(cells, 0.1, (0.5, 0.5), (2.0, 2.0), 0.1))
    assert caught.value.obstacles == ("map",)


def test_cells_that_touch_at_a_corner_let_nothing_through() -> None:
    cells = np.eye(12, dtype=bool)
    assert not found(mission(cells, 1.0, (1.5, 8.5), (8.5, 1.5), 0.01))


def test_the_same_map_gives_the_same_curve() -> None:
    cells = random_cells(np.random.default_rng(5))
    cells[0] = cells[-1] = False
    places = ((0.5, 0.5), (0.5 + cells.shape[1] - 1, cells.shape[0] - 0.5))
    first, second = (vs.plan(mission(cells, 1.0, *places, 0.2)) for _ in range(2))
    assert np.array_equal(first.path.spans, second.path.spans)
    assert repr(first.ledger) == repr(second.ledger)
