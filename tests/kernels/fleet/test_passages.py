"""Passages hold every box once, and bound what they hold."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from straight_fleets import (
    REACH,
    courses_on,
    crossings_on,
    lines_without_rests_in_the_way,
)

from viaspline.kernels.fleet.passages import passages_of


@pytest.mark.long_without_jit
@given(seed=st.integers(0, 10_000), count=st.integers(1, 9))
@settings(max_examples=30, deadline=None)
def test_passages_hold_every_box_once_and_bound_their_own_and_the_others_cells(
    seed: int, count: int
) -> None:
    courses = courses_on(lines_without_rests_in_the_way(seed, count), REACH)
    crossings = crossings_on(courses)
    found = passages_of(courses, crossings)
    assert sorted(found.box.tolist()) == list(range(crossings.cell.size))
    assert found.first[-1] == found.crossing.size == 2 * len(crossings.robots)
    for robot in range(courses.reach.size):
        mine = slice(found.first[robot], found.first[robot + 1])
        assert (np.diff(found.entry[mine]) >= 0).all()
        for p in range(mine.start, mine.stop):
            box = found.box[found.box_first[p] : found.box_first[p + 1]]
            assert (np.diff(box) > 0).all()
            assert set(crossings.crossing[box].tolist()) == {found.crossing[p]}
            assert set(crossings.other[box].tolist()) == {found.other[p]}
            assert crossings.cell[box].min() == found.entry[p]
            assert crossings.cell[box].max() == found.exit[p]
            last = courses.first[found.other[p] + 1] - 2
            assert courses.distance[found.low[p]] <= crossings.low[box].min()
            after = courses.distance[min(found.high[p], last) + 1]
            assert crossings.high[box].max() <= after


def test_a_fleet_without_crossings_has_no_passages() -> None:
    courses = courses_on([((0.0, 0.0), (9.0, 0.0)), ((0.0, 50.0), (9.0, 50.0))], REACH)
    found = passages_of(courses, crossings_on(courses))
    assert found.first.tolist() == [0, 0, 0]
    assert not found.box.size
