"""The search for a tension, beside times that are known for all of them."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
from hypothesis import example, given
from hypothesis import strategies as st

from viaspline.kernels.arrays import Floats, Ints
from viaspline.planning.turning.gentle_strip import MOST_TENSIONS
from viaspline.planning.turning.tension_search import (
    GENTLE_SHARE,
    RunPrice,
    TensionSearch,
    Tried,
)

LENGTH_M, LAID_S, LAID_BENDING, LEAST_S = 100.0, 40.0, 4.0, 25.0
SLOWING = 0.04
STRIP: Any = SimpleNamespace(spans=np.zeros((1, 4, 2)))


def no_time(spans: Floats, joints: Ints) -> float:
    raise AssertionError("all times are told")


def searched(soonest: float, tightest: float, saved: float, curved: float) -> TensionSearch:
    """The search among strips whose time is a valley over the logarithm of the tension.

    Args:
        soonest: The tension of the least time [1/m²].
        tightest: At which strips bend as much as what was laid, over that.
        saved: Of the laid time, at the least.
        curved: How much longer they take at ten times or a tenth of that tension, of the time.
    """
    price = RunPrice(no_time, LAID_S, LAID_BENDING, LEAST_S, SLOWING, SLOWING, 2.0, 2.0)
    search = TensionSearch(price, LENGTH_M)

    def at(tension: float) -> Tried:
        off = math.log10(tension / soonest)
        time = (1.0 - saved) * LAID_S * (1.0 + curved * off**2 / (1.0 + 0.3 * abs(off)))
        bending = LAID_BENDING * (tension / (tightest * soonest)) ** 0.25
        return Tried(tension, STRIP, time, bending)

    tension = search.first / LENGTH_M
    for _ in range(MOST_TENSIONS):
        search = search.having(at(tension))
        following = search.following
        if following is None:
            break
        tension = following[1]
    return search


@given(
    log_soonest=st.floats(-2.7, -0.7),
    tightest=st.floats(30.0, 1000.0),
    saved=st.floats(0.02, 0.1),
    curved=st.floats(0.005, 0.05),
)
@example(log_soonest=-1.0, tightest=100.0, saved=0.05, curved=0.02)
@example(log_soonest=-0.7, tightest=30.0, saved=0.02, curved=0.05)
@example(log_soonest=-2.7, tightest=1000.0, saved=0.1, curved=0.05)
def test_where_corners_slow_a_robot_down_the_soonest_tension_is_come_near_to(
    log_soonest: float, tightest: float, saved: float, curved: float
) -> None:
    search = searched(10.0**log_soonest, tightest, saved, curved)
    chosen = search.chosen
    assert chosen is not None
    assert chosen.time <= (1.0 + GENTLE_SHARE) * 1.0015 * (1.0 - saved) * LAID_S
    assert chosen.tension <= min(search.tried, key=lambda one: one.time).tension
    assert len(search.tried) <= MOST_TENSIONS


def test_a_tension_that_bends_more_is_taken_where_it_is_much_sooner() -> None:
    far, near = (searched(0.05, 0.01, saved, 0.02) for saved in (0.02, 0.003))
    assert far.chosen is not None
    assert far.chosen.bending > LAID_BENDING
    assert near.chosen is None
