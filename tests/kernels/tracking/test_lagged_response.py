import math

import numpy as np
import pytest

from viaspline.kernels.tracking.lagged_response import lagged_response


def test_without_a_limit_it_is_an_exponential() -> None:
    share = 1.0 - math.exp(-0.01 / 0.3)
    found = lagged_response(np.full(200, 2.0), share, np.inf, 0.5)
    expected = 2.0 - 1.5 * np.exp(-0.01 * np.arange(200) / 0.3)
    np.testing.assert_allclose(found, expected, atol=1e-12)


@pytest.mark.parametrize("to", [3.0, -3.0])
def test_it_changes_by_no_more_than_the_most_of_a_step(to: float) -> None:
    found = lagged_response(np.full(60, to), 0.5, 0.1, 0.0)
    assert np.abs(np.diff(found)).max() == pytest.approx(0.1)
    assert found[:20] == pytest.approx(math.copysign(0.1, to) * np.arange(20))
    assert found[-1] == pytest.approx(to, abs=1e-6)


def test_it_follows_what_was_commanded_a_step_before() -> None:
    assert lagged_response(np.array([1.0, 5.0, 2.0]), 1.0, np.inf, 0.0).tolist() == [0.0, 1.0, 5.0]
    assert lagged_response(np.zeros(0), 1.0, np.inf, 0.0).shape == (0,)
