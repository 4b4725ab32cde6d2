"""The wait that is to be expected, against the mean over many differences."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.kernels.fleet.expected_wait import expected_wait

SAMPLES = np.linspace(-8.0, 8.0, 20_001)
WEIGHTS = np.exp(-0.5 * SAMPLES**2) / np.exp(-0.5 * SAMPLES**2).sum()
times = st.floats(-30.0, 30.0)


@settings(max_examples=60, deadline=None)
@given(late=times, other_late=times, spread=st.floats(0.1, 5.0))
def test_it_is_the_mean_of_the_lesser_wait(late: float, other_late: float, spread: float) -> None:
    off = spread * SAMPLES
    waits = np.maximum(np.minimum(late + off, other_late - off), 0.0)
    assert expected_wait(late, other_late, spread) == pytest.approx(WEIGHTS @ waits, abs=1e-4)


def test_who_cannot_let_the_other_pass_is_let_pass() -> None:
    assert expected_wait(np.inf, 7.0, 0.01) == pytest.approx(7.0)
    assert expected_wait(7.0, np.inf, 0.01) == pytest.approx(7.0)
    assert expected_wait(np.inf, np.inf, 1.0) == 0.0


def test_where_nobody_can_wait_for_the_other_nothing_is_expected() -> None:
    assert expected_wait(-3.0, 2.0, 1.0) == 0.0
