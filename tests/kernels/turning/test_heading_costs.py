from __future__ import annotations

import math
from itertools import pairwise, product

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.kernels.turning.heading_costs import cheapest, leg_lengths
from viaspline.planning.turning.bend_row import DETOUR, Bends, bend
from viaspline.planning.turning.turn_path import RAMP, NoTurnPath, turn_path_on_sides, with_sides

RADIUS = 0.75
HEADINGS = np.arange(8) * (math.tau / 8)


def row(*bends: tuple[float, float, float, float]) -> np.ndarray:
    """Bends by place, what is kept and side, between two via points."""
    return np.array([bend(*each, RADIUS) for each in ((0, 0, 0, 0), *bends, (12, 1, 0, 0))])


def as_laid(rows: np.ndarray, start: float, goal: float) -> float:
    """The least length of the turn paths with these headings."""
    rows = rows.copy()
    rows[[0, -1], 4] = start, goal
    vias = np.array([0, *[DETOUR] * (len(rows) - 2), 1])
    laid = [turn_path_on_sides(each) for each in with_sides(Bends.free(rows, vias))]
    return min((path.length for path in laid if not isinstance(path, NoTurnPath)), default=math.inf)


def least(rows: np.ndarray, starts: np.ndarray, goals: np.ndarray) -> np.ndarray:
    found: np.ndarray = leg_lengths(rows, starts, goals, RAMP).min(axis=(2, 3))
    return found


def test_a_bend_that_the_others_make_needless_keeps_no_heading_from_being_reached() -> None:
    needed = row((4, 2, 0.5, -1), (8, 2, 0.5, -1))
    with_needless = row((4, 2, 0.5, -1), (6, 1.95, 0.5, -1), (8, 2, 0.5, -1))
    free = np.array([math.nan])
    lengths = least(with_needless, free, HEADINGS)
    assert np.isfinite(lengths).all()
    np.testing.assert_allclose(lengths, least(needed, free, HEADINGS), atol=1e-9)


@settings(max_examples=20, deadline=None)
@given(
    st.lists(
        st.tuples(
            st.floats(2, 10), st.floats(-2, 2), st.floats(0.3, 0.6), st.sampled_from((-1, 1))
        ),
        max_size=4,
    )
)
def test_a_leg_is_as_long_as_it_is_laid(bends: list[tuple[float, float, float, float]]) -> None:
    rows = row(*sorted(bends))
    starts, goals = np.array([math.nan, 0.3]), HEADINGS[::2]
    found = least(rows, starts, goals)
    for (i, start), (j, goal) in product(enumerate(starts), enumerate(goals)):
        assert found[i, j] <= as_laid(rows, start, goal) + 1e-6


@pytest.mark.parametrize("far", [0.3, 0.6, 1.5, 12.0])
def test_a_leg_is_as_long_as_it_is_laid_between_headings_near_its_line(far: float) -> None:
    rows = np.array([bend(*each, 0, 0, RADIUS) for each in ((0, 0), (far, 0))])
    headings = np.linspace(-0.2, 0.2, 9)
    found = least(rows, headings, headings)
    laid = [[as_laid(rows, start, goal) for goal in headings] for start in headings]
    np.testing.assert_allclose(found, laid, atol=1e-6)
    assert found[4, 4] == pytest.approx(far)
    assert found[3, 5] < 1.01 * far


@given(st.booleans(), st.integers(0, 2**32 - 1))
def test_the_cheapest_row_of_headings_is_that_of_brute_force(closed: bool, seed: int) -> None:
    random = np.random.default_rng(seed)
    counts = random.integers(1, 4, 4)
    if closed:
        counts[-1] = counts[0]
    costs = random.uniform(1, 9, (3, 3, 3))
    costs[random.random(costs.shape) < 0.3] = np.inf
    rows = [
        (sum(costs[k, i, j] for k, (i, j) in enumerate(pairwise(tried))), tried)
        for tried in product(*(range(count) for count in counts))
        if not closed or tried[0] == tried[-1]
    ]
    found, cost = cheapest(costs, counts, closed)
    assert cost == pytest.approx(min(rows)[0])
    if math.isfinite(cost):
        assert cost == pytest.approx(
            sum(costs[k, i, j] for k, (i, j) in enumerate(pairwise(found)))
        )
