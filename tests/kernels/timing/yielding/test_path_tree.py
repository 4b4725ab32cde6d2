"""A path in chords, and the circles over them."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.kernels.timing.yielding.path_tree import path_tree

PLACES = st.lists(
    st.tuples(*[st.integers(-20, 20)] * 2), min_size=3, max_size=6, unique=True
)  # fmt: skip


@given(PLACES, st.floats(0.05, 3.0))
def test_every_point_of_the_path_lies_within_the_miss_of_its_chord(
    places: list[tuple[int, int]], spacing: float
) -> None:
    path = CardinalSpline(places)
    _, along, points = path.sample(spacing)
    tree = path_tree(along, points)
    s = np.random.default_rng(1).uniform(0.0, path.length, 300)
    leaf = np.clip(np.searchsorted(along, s, side="right") - 1, 0, len(along) - 2)
    share = ((s - along[leaf]) / (along[leaf + 1] - along[leaf]))[:, None]
    on_chord = points[leaf] + share * (points[leaf + 1] - points[leaf])
    gap = np.hypot(*(path.at_distance(s) - on_chord).T)
    assert (gap <= tree.misses[leaf] + 1e-7 * (1.0 + path.length)).all()


@given(PLACES)
def test_circles_hold_all_points_below_them(places: list[tuple[int, int]]) -> None:
    path = CardinalSpline(places)
    _, along, points = path.sample(0.7)
    tree = path_tree(along, points)
    assert tree.skip[0] == len(tree.skip) == 2 * (len(along) - 1) - 1
    for (x, y, reach), (first, last) in zip(tree.circles, tree.runs, strict=True):
        assert np.hypot(*(points[first : last + 1] - (x, y)).T).max() <= reach + 1e-12
