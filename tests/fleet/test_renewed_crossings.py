"""Crossings of which some are found anew are all of them, box by box, as if found at once."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.fleet.courses import FleetPath, courses_along
from viaspline.fleet.crossings import crossings_of
from viaspline.fleet.renewed_crossings import patched_crossings, renewed_crossings

ROBOTS = 8


def spline(rng: np.random.Generator) -> FleetPath:
    path = CardinalSpline(rng.uniform(0, 30, (int(rng.integers(2, 6)), 2)), tension=0.0)
    return FleetPath(path, np.array([0.0, path.length]), float(rng.uniform(0.3, 1.5)))


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 100_000), st.integers(1, ROBOTS))
def test_they_are_those_that_are_found_at_once(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    names = [f"r{k}" for k in range(ROBOTS)]
    paths = [spline(rng) for _ in names]
    old = courses_along(names, paths)
    changed = np.sort(rng.permutation(ROBOTS)[:count])
    for robot in changed:
        paths[robot] = spline(rng)
    courses = courses_along(names, paths)
    found = renewed_crossings(crossings_of(old), old, courses, changed).packed
    at_once = crossings_of(courses).packed
    for key, values in at_once._asdict().items():
        assert np.array_equal(getattr(found, key), values), key
        assert getattr(found, key).dtype == values.dtype


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 100_000), st.integers(1, 3))
def test_robots_may_have_come_behind_the_others(seed: int, count: int) -> None:
    rng = np.random.default_rng(seed)
    names = [f"r{k}" for k in range(ROBOTS)]
    paths = [spline(rng) for _ in names]
    stay = ROBOTS - count
    old, courses = courses_along(names[:stay], paths[:stay]), courses_along(names, paths)
    found = renewed_crossings(crossings_of(old), old, courses, np.arange(stay, ROBOTS)).packed
    for key, values in crossings_of(courses).packed._asdict().items():
        assert np.array_equal(getattr(found, key), values), key


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 100_000), st.integers(1, 4), st.booleans())
def test_what_is_not_put_among_each_other_yet_says_the_same(
    seed: int, changes: int, is_asked: bool
) -> None:
    """Others change, or come behind them, one after the other; now and then boxes are asked for."""
    rng = np.random.default_rng(seed)
    paths = [spline(rng) for _ in range(ROBOTS)]
    courses = courses_along([f"r{k}" for k in range(len(paths))], paths)
    crossings = crossings_of(courses)
    for _ in range(changes):
        robot = int(rng.integers(0, len(paths) + 1))
        paths[robot : robot + 1] = [spline(rng)]
        old, courses = courses, courses_along([f"r{k}" for k in range(len(paths))], paths)
        changed = np.array([robot])
        fresh = crossings_of(courses, changed).packed
        crossings = patched_crossings(crossings, old, courses, changed, fresh)
        at_once = crossings_of(courses)
        assert np.array_equal(crossings.robots, at_once.robots)
        assert np.array_equal(crossings.span, at_once.span)
        chosen = rng.random(len(paths)) < 0.5
        for one, two in zip(crossings.boxes_of(chosen), at_once.boxes_of(chosen), strict=True):
            assert np.array_equal(one, two)
        assert not is_asked or crossings == at_once
    assert crossings == at_once


def test_a_robot_that_crosses_nobody_any_more_leaves_no_crossing() -> None:
    rng = np.random.default_rng(3)
    names, paths = ["a", "b", "c"], [spline(rng) for _ in range(3)]
    old = courses_along(names, paths)
    before = crossings_of(old)
    assert (before.packed.robots == 1).any()
    away = CardinalSpline([[900.0, 900.0], [930.0, 910.0]], tension=0.0)
    paths[1] = FleetPath(away, np.array([0.0, away.length]), 1.0)
    courses = courses_along(names, paths)
    found = renewed_crossings(before, old, courses, np.array([1])).packed
    assert not (found.robots == 1).any()
    assert found.box_first[1] == found.box_first[2]
