import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from viaspline.kernels.routing.tour import shortened_tour


def length(xy: np.ndarray, tour: np.ndarray) -> float:
    return float(np.hypot(*np.diff(xy[tour], axis=0).T).sum())


def shortened(xy: np.ndarray, most: int = 10_000) -> np.ndarray:
    near = cKDTree(xy).query(xy, min(8, len(xy) - 1) + 1)[1][:, 1:]
    return shortened_tour(xy, np.arange(len(xy)), np.ascontiguousarray(near, np.int64), most)


@given(st.integers(0, 10_000), st.integers(4, 60), st.integers(0, 200))
def test_a_tour_stays_one_from_the_first_to_the_last_and_gets_no_longer(
    seed: int, count: int, most: int
) -> None:
    xy = np.random.default_rng(seed).uniform(0, 100, (count, 2))
    before = length(xy, np.arange(count))
    for exchanges in (most, 10_000):
        tour = shortened(xy, exchanges)
        assert sorted(tour) == list(range(count))
        assert (tour[0], tour[-1]) == (0, count - 1)
        assert length(xy, tour) <= before + 1e-6
        before = length(xy, tour)


def test_places_on_a_line_come_one_after_the_other() -> None:
    x = np.concatenate([[0.0], np.random.default_rng(1).permutation(np.arange(1.0, 40)), [40.0]])
    tour = shortened(np.column_stack([x, 0 * x]))
    assert length(np.column_stack([x, 0 * x]), tour) == pytest.approx(40.0, rel=0.5)


@pytest.mark.long_without_jit
def test_among_random_places_a_tour_is_a_few_percent_longer_than_the_shortest() -> None:
    # The shortest through many is 0.7124 sqrt(n area) long (Johnson, McGeoch, Rothberg 1996).
    xy = np.random.default_rng(2).uniform(0, 1, (1000, 2))
    assert length(xy, shortened(xy)) < 1.15 * 0.7124 * np.sqrt(1000)
