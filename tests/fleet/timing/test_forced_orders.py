"""Who has to pass first because of where robots stand, and orders that keep that."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from straight_fleets import courses_on, crossings_on

from viaspline.fleet.timing.forced_orders import forced_orders, timing_order
from viaspline.kernels.fleet.passages import passages_of

STAYS = np.zeros(2, np.bool_)
LINE = ((0.0, 0.0), (40.0, 0.0))


@pytest.mark.parametrize(
    ("other", "pairs"),
    [
        (((20.0, 0.5), (20.0, 20.0)), [[1, 0]]),  # it stands in the way until it leaves
        (((20.0, 20.0), (20.0, 0.5)), [[0, 1]]),  # it rests in the way once it has come
        (((20.0, -20.0), (20.0, 20.0)), []),
        (((40.0, 0.0), (0.0, 0.0)), []),  # each stands where the other wants to go: either is first
    ],
)
def test_who_stands_in_the_way_leaves_first_and_comes_last(
    other: tuple[tuple[float, float], tuple[float, float]], pairs: list[list[int]]
) -> None:
    courses = courses_on([LINE, other], 1.0)
    passages = passages_of(courses, crossings_on(courses))
    assert forced_orders(courses, passages, STAYS).tolist() == pairs


def test_who_leaves_the_world_rests_in_nobodys_way() -> None:
    courses = courses_on([LINE, ((20.0, 20.0), (20.0, 0.5))], 1.0)
    passages = passages_of(courses, crossings_on(courses))
    assert not forced_orders(courses, passages, ~STAYS).size


@given(
    pairs=st.lists(st.tuples(st.integers(0, 7), st.integers(0, 7)), max_size=20),
    ranks=st.lists(st.integers(0, 3), min_size=8, max_size=8),
)
def test_an_order_keeps_all_pairs_and_names_who_waits_in_circles(
    pairs: list[tuple[int, int]], ranks: list[int]
) -> None:
    found = timing_order(np.array(pairs, np.int64).reshape(-1, 2), [(float(r),) for r in ranks])
    place = {robot: k for k, robot in enumerate(found.order.tolist())}
    assert sorted([*place, *found.circular.tolist()]) == list(range(8))
    for before, after in pairs:
        if after in place:
            assert place[before] < place[after]
    for robot in found.circular.tolist():  # each waits for another one of them
        assert any(after == robot and before in found.circular for before, after in pairs)
