"""Crossings of barriers by whole curves, against dense points and shapely."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import example, given, settings
from hypothesis import strategies as st

from viaspline.planning.checking.barrier_crossings import crossings

PLACES = 2001  # on a span, for the oracle


def dense(span: np.ndarray) -> shapely.LineString:
    w = np.linspace(0, 1, PLACES)[:, None]
    a, b, c, d = span
    return shapely.LineString(
        (1 - w) ** 3 * a + 3 * w * (1 - w) ** 2 * b + 3 * w**2 * (1 - w) * c + w**3 * d
    )


@settings(max_examples=60)
@given(st.integers(0, 100_000))
@example(0)
def test_what_crosses_is_what_shapely_sees_crossing(seed: int) -> None:
    rng = np.random.default_rng(seed)
    spans, barriers = rng.normal(0, 5, (4, 4, 2)), rng.normal(0, 5, (6, 4))
    found = crossings(spans, barriers)
    for i, span in enumerate(spans):
        line = dense(span)
        for k, barrier in enumerate(barriers):
            segment = shapely.LineString(barrier.reshape(2, 2))
            if line.intersects(segment):
                assert found[i, k]
            elif line.distance(segment) > 1e-3:
                assert not found[i, k]


@pytest.mark.parametrize(
    ("barrier", "met"),
    [
        ([5, -1, 5, 1], True),
        ([5, 0, 5, 1], True),  # it touches the line with its end
        ([5, 1e-9, 5, 1], False),
        ([2, 0, 3, 0], True),  # it lies in the line
        ([11, 0, 12, 0], False),
        ([0, -1, 0, 1], True),  # at its start
    ],
)
def test_touching_counts_and_a_billionth_beside_does_not(barrier: list, met: bool) -> None:
    line = np.array([[[0, 0, 7], [3, 0, 7], [7, 0, 7], [10, 0, 7]]], np.float64)
    assert crossings(line, np.array([barrier], np.float64)).tolist() == [[met]]


def test_a_curve_that_crosses_and_comes_back_has_crossed() -> None:
    bow = np.array([[[0, 0], [0, 4], [4, 4], [4, 0]]], np.float64)
    assert crossings(bow, np.array([[-1, 2.9, 5, 2.9]], np.float64)).all()
    assert not crossings(bow, np.array([[-1, 3.1, 5, 3.1]], np.float64)).any()


def test_no_barriers_are_not_crossed() -> None:
    assert crossings(np.zeros((3, 4, 2)), np.empty((0, 4))).shape == (3, 0)
