"""The time law under coupled limits against scipy's programmes; small, for no JIT."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import linprog

from viaspline.kernels.timing import reachability


def test_every_step_backwards_is_the_optimum_of_its_programme() -> None:
    rng = np.random.default_rng(0)
    n = 40
    planes = np.concatenate((rng.normal(0, 1, (n, 10, 2)), rng.uniform(0.1, 2, (n, 10, 1))), axis=2)
    caps = np.full(n + 1, 3.0)
    caps[-1] = 1.0
    line = np.arange(n + 1.0)
    squares, over, missed = reachability.reachable_profile(line, planes, caps, 1.0, 0.0)
    assert (over, squares[0]) == (0.0, 0.0)
    assert np.isnan(missed)
    back = caps[-1]
    for i in range(n - 1, -1, -1):
        best = linprog(
            [-1, 0], A_ub=planes[i, :, :2], b_ub=planes[i, :, 2], bounds=[(0, caps[i]), (0, back)]
        )
        back = float(best.x[0])
    first, _, _ = reachability.reachable_profile(line, planes, caps, 1.0, back)
    assert first[0] == pytest.approx(back, rel=1e-9)
    used = planes[:, :, 0] * squares[:-1, None] + planes[:, :, 1] * squares[1:, None]
    assert np.all(used <= planes[:, :, 2] + 1e-9)
