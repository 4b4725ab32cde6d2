from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.report.box_sums import BoxSums


@settings(max_examples=30)
@given(st.integers(0, 9999), st.integers(1, 12), st.integers(1, 12))
def test_sums_are_those_of_the_cells_that_a_box_touches(seed: int, rows: int, columns: int) -> None:
    rng = np.random.default_rng(seed)
    image = rng.uniform(0.0, 1.0, (rows, columns))
    sums = BoxSums.of_image(image, np.array([3.0, 5.0]), 2.0)
    low = rng.integers(-2, 30, 2).astype(float) + 0.5
    high = low + rng.integers(0, 20, 2)
    expected = 0.0
    for row, column in np.ndindex(rows, columns):
        cell = np.array([3.0, 5.0]) + 2.0 * np.array([column, row])
        if (cell < high).all() and (cell + 2.0 > low).all():
            expected += image[row, column]
    assert np.isclose(sums.within(np.array([[*low, *high]]))[0], expected)


def test_points_beyond_the_area_and_those_that_are_none_do_not_count() -> None:
    points = np.array([[1.0, 1.0], [1.5, 1.5], [7.0, 3.0], [-1.0, 2.0], [np.nan, 2.0], [99.0, 2.0]])
    sums = BoxSums.of_points(points, np.array([0.0, 0.0, 10.0, 10.0]), 2.0)
    assert sums.within(np.array([[0.0, 0.0, 10.0, 10.0]]))[0] == 2.0
