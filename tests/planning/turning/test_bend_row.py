"""A row of bends, thinned."""

from __future__ import annotations

import math

import numpy as np
import shapely
from hypothesis import given
from hypothesis import strategies as st

from viaspline.kernels.turning.settled_lines import SIDE, X, Y
from viaspline.planning.turning.bend_row import DETOUR, Bends


def random_row(seed: int, count: int) -> Bends:
    """Detours from via point to via point, some of these between them."""
    rng = np.random.default_rng(seed)
    rows = np.full((count, 6), math.nan)
    rows[:, X] = np.cumsum(rng.uniform(0.1, 2.0, count))
    rows[:, Y] = np.cumsum(rng.choice([0.0, 0.05, 0.5], count) * rng.choice([-1.0, 1.0], count))
    rows[:, SIDE] = rng.choice([1.0, 1.0, 1.0, -1.0], count)
    vias = np.where(rng.random(count) < 0.1, np.arange(count), DETOUR)
    vias[[0, -1]] = 0, count
    return Bends.free(rows, vias)


def thinned_by_hand(bends: Bends, off: float) -> list[int]:
    """One bend after the other, with shapely's distances."""
    left = list(range(len(bends.rows)))
    while True:
        offs = {}
        for k in range(2, len(left) - 2):
            three = left[k - 1 : k + 2]
            sides, vias = bends.rows[three, SIDE], bends.vias[three]
            if (vias == DETOUR).all() and np.ptp(sides) == 0.0:
                before, at, after = bends.rows[three, : Y + 1]
                far = 1e3 * (after - before)  # the line, not the stretch of it
                line = shapely.LineString([before - far, after + far])
                offs[k] = line.distance(shapely.Point(at))
        least = min(offs, key=lambda k: offs[k], default=None)
        if least is None or offs[least] > off:
            return left
        del left[least]


@given(st.integers(0, 100_000), st.integers(2, 25), st.floats(0.01, 0.6))
def test_detours_hardly_off_the_line_of_others_are_left_out_one_by_one(
    seed: int, count: int, off: float
) -> None:
    bends = random_row(seed, count)
    left = thinned_by_hand(bends, off)
    assert np.array_equal(bends.thinned(off).rows, bends.rows[left], equal_nan=True)
