"""The chords of a path against places of it that are looked up one by one."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.path import Path
from viaspline.trajectory.yielding.road import CHORD_MISS_M, MIN_CHORD_M, Road


@given(st.integers(0, 2**32 - 1))
@settings(deadline=None, max_examples=40)
def test_no_place_of_a_path_is_farther_from_its_chord_than_is_said(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = np.cumsum(rng.normal(0, 4, (int(rng.integers(3, 8)), 2)), axis=0)
    path = CardinalSpline(points, knots=str(rng.choice(["centripetal", "chordal"])))
    tree = Road.of(path).tree
    assert tree.along[0] == 0.0
    assert np.all(np.diff(tree.along) > 0.0)
    assert abs(tree.along[-1] - path.length) < 1e-9 * path.length
    for share in (0.2, 0.5, 0.9):
        on_chord = tree.points[:-1] + share * np.diff(tree.points, axis=0)
        away = path.at_distance(tree.along[:-1] + share * np.diff(tree.along)) - on_chord
        assert np.all(np.hypot(*away.T) <= tree.misses + 1e-9)
    long = np.diff(tree.along) > 2.0 * MIN_CHORD_M
    assert np.all(tree.misses[long] <= 1.1 * CHORD_MISS_M)


def test_a_straight_path_is_one_chord_a_span_and_a_bent_one_as_many_as_it_needs() -> None:
    straight = Path(np.array([[[0.0, 0], [100, 0], [200, 0], [300, 0]]]), vias=[])
    assert len(Road.of(straight).tree.misses) == 1
    gentle, sharp = (
        Path(np.array([[[0.0, 0], [10, high], [20, high], [30, 0]]]), vias=[]) for high in (2, 12)
    )
    few, many = (len(Road.of(path).tree.misses) for path in (gentle, sharp))
    assert 8 <= few < many <= 1024


def test_a_sharp_bend_makes_short_chords_only_where_it_is() -> None:
    hook = CardinalSpline([(0, 0), (100, 0), (100.02, 0.01), (100, 0.02), (0, 30)])
    road = Road.of(hook)
    assert road.bend > 10.0
    assert len(road.tree.misses) < 1000
    assert road.tree.misses[np.diff(road.tree.along) > 0.1].max() < 0.001
    s = np.linspace(0.0, hook.length, 5000)
    leaf = np.clip(np.searchsorted(road.tree.along, s, side="right") - 1, 0, None)
    leaf = np.minimum(leaf, len(road.tree.misses) - 1)
    begin, end = road.tree.points[leaf], road.tree.points[leaf + 1]
    share = (s - road.tree.along[leaf]) / np.diff(road.tree.along)[leaf]
    off = np.hypot(*(begin + share[:, None] * (end - begin) - hook.at_distance(s)).T)
    assert (off <= road.tree.misses[leaf] + 1e-9).all()
