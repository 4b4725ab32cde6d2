"""Radii of corners that share sides: none into another one, the smallest as large as can be."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import linprog

from viaspline.kernels.arrays import Floats
from viaspline.kernels.space.shared_sides import shared_radii

seeds = st.integers(0, 10_000)


def drawn(seed: int) -> tuple[Floats, Floats, Floats]:
    """Sides, reaches for a radius of 1 m, and radii that are wanted."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 7))
    reaches = np.where(rng.random(count) < 0.1, 0.0, rng.uniform(0.1, 5, count))
    return 10 ** rng.uniform(-2, 1, count + 1), reaches, 10 ** rng.uniform(-2, 1.5, count)


def taken(reaches: Floats, radii: Floats) -> Floats:
    """What the roundings at both ends of each side take of it [m]."""
    own = reaches * radii
    return np.concatenate(([0.0], own)) + np.concatenate((own, [0.0]))


@given(seed=seeds)
def test_no_rounding_reaches_into_another_one_and_none_is_wider_than_wanted(seed: int) -> None:
    sides, reaches, wanted = drawn(seed)
    radii = shared_radii(sides, reaches, wanted)
    assert (taken(reaches, radii) <= sides * (1 + 1e-9)).all()
    assert (radii <= wanted).all()


@given(seed=seeds)
def test_the_smallest_radius_is_as_large_as_a_linear_programme_finds(seed: int) -> None:
    sides, reaches, wanted = drawn(seed)
    rounded = np.flatnonzero(reaches > 0.0)
    if not len(rounded):
        return
    count = len(wanted)
    rows = np.zeros((len(sides), count + 1))
    for side in range(len(sides)):
        for corner in (side - 1, side):
            if 0 <= corner < count:
                rows[side, corner] = reaches[corner]
    levels = np.zeros((len(rounded), count + 1))
    levels[np.arange(len(rounded)), rounded] = -1.0
    levels[:, -1] = 1.0
    best = linprog(
        np.append(np.zeros(count), -1.0),
        np.vstack((rows, levels)),
        np.append(sides, np.zeros(len(rounded))),
        bounds=[(0.0, most) for most in wanted] + [(0.0, None)],
    )
    found = shared_radii(sides, reaches, wanted)[rounded].min()
    assert found == pytest.approx(-best.fun, rel=1e-6)


@given(seed=seeds)
def test_a_corner_is_as_wide_as_wanted_or_one_of_its_sides_is_full(seed: int) -> None:
    sides, reaches, wanted = drawn(seed)
    radii = shared_radii(sides, reaches, wanted)
    full = taken(reaches, radii) >= sides * (1 - 1e-9)
    assert ((radii == wanted) | full[:-1] | full[1:]).all()
