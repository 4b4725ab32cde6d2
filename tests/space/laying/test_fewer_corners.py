"""Corners taken as fewer: what they are replaced by lies outside of all of them."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from viaspline.kernels.arrays import Floats
from viaspline.space.laying.fewer_corners import fewer_corners


def round_a_pillar(seed: int) -> Floats:
    """A way that turns by a little at each of many corners about a pillar."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 8))
    turns = np.sort(rng.uniform(0.0, 1.5, count))
    arc = np.column_stack((np.sin(turns), -np.cos(turns), 0.1 * turns))
    first, last = arc[0] - [9.0, 0, 0], arc[-1] + [0.0, 9, 0]
    return np.concatenate((first[None], arc, last[None]))


@given(seed=st.integers(0, 10_000))
def test_several_corners_become_one_that_all_of_them_lie_inside_of(seed: int) -> None:
    points = round_a_pillar(seed)
    corner = 1 + seed % (len(points) - 2)
    for first, last, instead in fewer_corners(points, corner, 2.0):
        assert 1 <= first <= corner <= last <= len(points) - 2
        if not len(instead):
            continue
        before = points[first] - points[first - 1]
        after = points[last + 1] - points[last]
        out = before / np.linalg.norm(before) - after / np.linalg.norm(after)
        assert ((points[first : last + 1] - instead[0]) @ out <= 1e-9).all()


def test_a_corner_alone_is_left_out() -> None:
    points = np.array([[0.0, 0, 5], [5, 1, 5], [10, 0, 5]])
    assert [(a, b, len(c)) for a, b, c in fewer_corners(points, 1, 1.0)] == [(1, 1, 0)]


def test_corners_that_are_far_apart_stay_as_they_are() -> None:
    points = np.array([[0.0, 0, 5], [50, 0, 5], [50, 90, 5], [0, 90, 5]])
    assert [(a, b) for a, b, _ in fewer_corners(points, 1, 1.0)] == [(1, 1)]
