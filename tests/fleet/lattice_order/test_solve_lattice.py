import numpy as np

from viaspline.fleet.lattice_order.no_lattice_order import NoLatticeOrder
from viaspline.fleet.lattice_order.solve_lattice import LatticePlan, solve_lattice

ROW = np.array([[1, -1, -1], [2, 0, -1], [3, 1, 4], [-1, 2, -1], [-1, -1, 2]], np.int32)
"""Four cells in a row, and a bay beside the third."""


def cells(*numbers):
    return np.array(numbers, np.int32)


def test_robots_change_places_at_a_bay():
    plan = solve_lattice(ROW, cells(0, 3), cells(3, 0), work=10_000)
    assert isinstance(plan, LatticePlan)
    assert plan.places[:, 0].tolist() == [0, 3]
    assert plan.places[:, -1].tolist() == [3, 0]
    assert plan.shortest.tolist() == [3, 3]
    assert (plan.arrivals >= plan.shortest).all()
    for before, after in zip(plan.places.T, plan.places.T[1:], strict=False):
        assert after[0] != after[1]
        assert after[0] == before[0] or after[0] != before[1]
        assert after[1] == before[1] or after[1] != before[0]


def test_a_row_without_a_bay_is_refused():
    found = solve_lattice(
        cells([1, -1], [2, 0], [-1, 1]).reshape(3, 2), cells(0, 2), cells(2, 0), work=10_000
    )
    assert isinstance(found, NoLatticeOrder)
    assert found.outcome == "refused"


def test_cells_without_a_way_between_them_are_refused():
    apart = cells([-1], [-1])
    found = solve_lattice(apart, cells(0), cells(1))
    assert isinstance(found, NoLatticeOrder)
    assert found.outcome == "refused"


def test_it_gives_up_when_work_runs_out():
    found = solve_lattice(ROW, cells(0, 1, 3), cells(3, 0, 1), work=2)
    assert isinstance(found, NoLatticeOrder)
    assert found.outcome == "gave up"


def test_nobody_has_nowhere_to_go():
    plan = solve_lattice(ROW, cells(), cells())
    assert isinstance(plan, LatticePlan)
    assert plan.places.shape[0] == 0


def test_it_gives_the_same_each_time():
    grid = np.arange(36).reshape(6, 6)
    padded = np.pad(grid, 1, constant_values=-1)
    beside = padded[1:-1, 2:], padded[2:, 1:-1], padded[1:-1, :-2], padded[:-2, 1:-1]
    neighbours = np.stack(beside, axis=-1).reshape(36, 4).astype(np.int32)
    starts = np.arange(0, 36, 3, dtype=np.int32)
    goals = np.roll(starts, 5)
    plans = [solve_lattice(neighbours, starts, goals, work=20_000) for _ in range(2)]
    assert isinstance(plans[0], LatticePlan)
    assert isinstance(plans[1], LatticePlan)
    assert plans[0].places.tobytes() == plans[1].places.tobytes()


def test_a_robot_that_leaves_lets_others_pass_where_it_would_have_stood():
    row = np.array([[1, -1], [2, 0], [3, 1], [-1, 2]], np.int32)
    stays = solve_lattice(row, cells(1, 0), cells(2, 3))
    assert isinstance(stays, NoLatticeOrder)
    leaves = solve_lattice(row, cells(1, 0), cells(2, 3), leaves=np.array([True, False]))
    assert leaves.places[:, -1].tolist() == [2, 3]


def test_a_robot_stands_at_its_start_until_it_departs():
    plan = solve_lattice(ROW, cells(2, 0), cells(3, 2), departs=np.array([5, 0], np.int32))
    assert plan.places[0, :6].tolist() == [2] * 6
    assert plan.arrivals[1] > 6
