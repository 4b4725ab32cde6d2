"""Where the nodes of a time law lie; small, for no JIT."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from viaspline.kernels.timing import time_grid

NONE = np.empty(0)


def test_nodes_are_marks_and_ends_of_cells_and_know_their_cell() -> None:
    along = np.array([0.0, 1.0, 2.0, 3.0])
    line, cell, ends = time_grid.divide(along, np.array([0.5, 1.0, 1.25, 2.5]), 1e-9)
    assert line.tolist() == [0.5, 1.0, 1.25, 2.0, 2.5]
    assert cell.tolist() == [0, 1, 1, 2]
    assert ends.ravel().tolist() == [0.5, 1, 0, 0.25, 0.25, 1, 0, 0.5]


@pytest.mark.parametrize("seed", range(20))
def test_stops_and_edges_are_marks_in_order_and_none_is_close_to_them(seed: int) -> None:
    rng = np.random.default_rng(seed)
    along = np.concatenate(([0.0], np.sort(rng.uniform(0, 50, 30)), [50.0]))
    stops = np.concatenate(([0.0], np.sort(rng.uniform(0, 50, 3)), [50.0]))
    edges = np.unique(np.concatenate((rng.uniform(0, 50, 4), stops[2:3])))
    found = time_grid.marks(along, stops, edges, seed % 2 == 0, 3.0, 1e-6)
    assert np.all(np.diff(found) > 0)
    fixed = np.union1d(stops, edges)
    assert np.isin(fixed, found).all()
    free = np.setdiff1d(found, fixed)
    assert np.abs(free[:, None] - fixed).min() > 1e-6
    for low, high in pairwise(stops):
        every = np.union1d(found, along)  # what is near ends of cells is left out
        assert np.diff(every[(every >= low) & (every <= high)]).max() <= (high - low) / 7


def test_from_a_start_farther_on_the_lattice_is_the_same_or_finer() -> None:
    along = np.array([0.0, 1000.0])
    whole = time_grid.marks(along, np.array([0.0, 1000.0]), NONE, False, 1e-3, 1e-6)
    rest = time_grid.marks(along, np.array([300.1, 1000.0]), NONE, False, 1e-3, 1e-6)
    far = whole[(whole > 310.0) & (whole < 990.0)]
    assert far.size > 4
    assert np.isin(far, rest).all()


def test_a_line_is_refined_where_the_acceleration_changes_and_nowhere_else() -> None:
    line = np.arange(41.0)
    accel = np.where(line[:-1] < 20, 1.0, 1.0 - 0.04 * (line[:-1] - 20))
    squares = np.concatenate(([1.0], 1.0 + np.cumsum(2 * accel)))
    finer = time_grid.refined(line, squares, 0.0, 1.0, 1e-4, 1e-3, 16)
    assert np.isin(line, finer).all()
    assert not np.any((finer > 0) & (finer < 19) & (finer % 1 > 0))
    assert np.sum((finer > 20) & (finer % 1 > 0)) >= 20
    assert np.array_equal(time_grid.refined(line, squares, 0.0, 1.0, 1.0, 1e-3, 16), line)


def test_where_a_drive_begins_by_braking_it_is_as_fine_as_can_be() -> None:
    line, squares = np.arange(11.0), np.array([9, 7, 5, 3, 1, 3, 5, 7, 7, 7, 7.0])
    finer = time_grid.refined(line, squares, 1.5, 1.0, 1.0, 1.0, 8)
    assert finer.tolist() == [*np.arange(0, 4, 0.125).tolist(), *line[4:].tolist()]


@pytest.mark.parametrize("apart", [0.0, 2e-15, 1e-12, 1e-9])
def test_stops_that_only_rounding_keeps_apart_have_no_nodes_between_them(apart: float) -> None:
    along = np.linspace(0.0, 40.0, 401)
    stops = np.array([0.0, 12.157435984, 12.157435984 + apart, 40.0])
    marks = time_grid.marks(along, stops, np.empty(0), False, 0.8, 4e-8)
    assert np.count_nonzero(np.abs(marks - stops[1]) < 1e-6) == 2
    assert np.all(np.diff(marks) >= 0.0)
