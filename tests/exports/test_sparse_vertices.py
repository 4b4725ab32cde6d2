"""Few vertices: as few as a search over all choices finds."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.exports.chord_bound import chord_bound
from viaspline.exports.sparse_vertices import sparse_parameters

numbers = st.floats(-20, 20).map(lambda x: round(x, 2))


def fewest(count: int, may_join: np.ndarray) -> int:
    """How many of evenly spaced places there have to be, by all choices."""
    least = [0] + [count] * (count - 1)
    for j in range(1, count):
        least[j] = 1 + min(least[i] for i in range(j) if may_join[i, j])
    return least[-1]


@pytest.mark.slow
@settings(max_examples=15, deadline=None)
@given(st.lists(st.tuples(numbers, numbers), min_size=3, max_size=5, unique=True))
def test_there_are_hardly_more_lines_than_the_best_choice_has(
    points: list[tuple[float, float]],
) -> None:
    curve = CardinalSpline(points)
    error = 0.2

    def may_join(a: float, b: float) -> bool:
        return chord_bound(curve, a, b) <= error

    end = curve.domain[1]
    found = sparse_parameters([0.0, end], may_join)
    assert all(may_join(a, b) for a, b in pairwise(found))
    grid = np.linspace(0.0, end, 61)
    table = np.array([[i < j and may_join(a, b) for j, b in enumerate(grid)]
                      for i, a in enumerate(grid)])  # fmt: skip
    neighbours = np.arange(60)
    if table[neighbours, neighbours + 1].all():
        assert len(found) - 1 <= 1.1 * fewest(61, table) + 1


def test_fixed_places_are_among_them() -> None:
    assert sparse_parameters([0.0, 1.5, 4.0], lambda a, b: True) == [0.0, 1.5, 4.0]


def test_what_may_never_be_joined_ends_all_the_same() -> None:
    found = sparse_parameters([0.0, 1e-5], lambda a, b: False)
    assert found[-1] == 1e-5
    assert len(found) <= 102
