"""Ways with fewer corners, by costs of the test's own."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.kernels.arrays import Floats
from viaspline.space.laying.sooner_corners import MOST_TRIED, sooner_corners


def zigzag(seed: int) -> Floats:
    rng = np.random.default_rng(seed)
    steps = rng.uniform((0.5, -4, -2), (20, 4, 2), (int(rng.integers(2, 12)), 3))
    return np.concatenate((np.zeros((1, 3)), np.cumsum(steps, axis=0)))


@settings(max_examples=40)
@given(seed=st.integers(0, 10_000))
def test_what_is_taken_costs_no_more_and_joins_the_same_places(seed: int) -> None:
    way, asked = zigzag(seed), []

    def bends(points: Floats) -> float:
        """Length, and what each corner costs by how much it turns and how short its sides are."""
        asked.append(points)
        sides = np.diff(points, axis=0)
        sizes = np.linalg.norm(sides, axis=1)
        units = sides / sizes[:, None]
        turns = np.linalg.norm(np.diff(units, axis=0), axis=1)
        return float(sizes.sum() + (turns / np.minimum(sizes[1:], sizes[:-1])).sum())

    taken = sooner_corners(way, 10.0, bends)
    assert np.array_equal(taken[[0, -1]], way[[0, -1]])
    assert 2 <= len(taken) <= len(way)
    assert bends(taken) <= bends(way)
    assert len(asked) <= MOST_TRIED + 4
    assert all(np.linalg.norm(np.diff(one, axis=0), axis=1).min() > 0.0 for one in asked)


def test_a_way_whose_corners_are_all_needed_stays_as_it_is() -> None:
    way = zigzag(3)
    assert np.array_equal(
        sooner_corners(way, 10.0, lambda points: 1.0 if len(points) == len(way) else np.inf), way
    )


def test_two_bends_close_to_each_other_become_one_outside_of_them() -> None:
    way = np.array([[0.0, 0, 5], [50, 5, 5], [53, 5, 5], [100, 0, 5]])

    def past_a_post(points: Floats) -> float:
        """Whoever has a line on the inner side of the two corners doesn't get past."""
        inside = [np.interp(x, points[:, 0], points[:, 1]) < 5.0 - 1e-9 for x in (50.0, 53.0)]
        return np.inf if any(inside) else float(len(points))

    [corner] = sooner_corners(way, 5.0, past_a_post)[1:-1]
    assert 50.0 < corner[0] < 53.0
    assert corner[1] > 5.0
