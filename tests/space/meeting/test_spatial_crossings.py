"""Where courses in space come near each other, against places sampled on both."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.path import Path
from viaspline.errors import GaveUpError
from viaspline.fleet.courses import FleetCourses, FleetPath, courses_along
from viaspline.fleet.crossings import crossings_of
from viaspline.space.among.courses_among import courses_among
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.meeting.gap_of_bodies import BodyPair, gap_slopes, gaps_of
from viaspline.space.meeting.spatial_crossings import spatial_crossings
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.retime import retime

Floats = NDArray[np.float64]


def flown(points: Floats, body: tuple[float, float, float]) -> FleetPath:
    path = Path(CardinalSpline(points).spans, vias=[])
    return FleetPath(path, np.array([0.0, path.length]), body[0] + body[2], body)


def random_courses(seed: int) -> tuple[list[FleetPath], FleetCourses]:
    rng = np.random.default_rng(seed)
    paths = [
        flown(rng.uniform((0, 0, 0), (12, 12, 8), (int(rng.integers(2, 5)), 3)), body)
        for body in ((0.5, 0.2, 0.4), (0.0, 0.0, 0.8), (1.0, 0.6, 0.3))
    ]
    return paths, courses_along(["a", "b", "c"], paths)


@settings(max_examples=20)
@given(seed=st.integers(0, 10_000))
def test_all_places_that_are_too_near_are_in_boxes_from_either_side(seed: int) -> None:
    paths, courses = random_courses(seed)
    packed, found = courses.packed, crossings_of(courses).packed
    for one in range(3):
        for other in range(3):
            if one == other:
                continue
            body = np.array(paths[one].body) + np.array(paths[other].body)
            s, t = (np.linspace(0, paths[k].path.length, 300) for k in (one, other))
            off = paths[one].path.at_distance(s)[:, None] - paths[other].path.at_distance(t)[None]
            level = np.maximum(np.hypot(off[..., 0], off[..., 1]) - body[0], 0.0)
            upright = np.maximum(np.abs(off[..., 2]) - body[1], 0.0)
            near = np.hypot(level, upright) < body[2] - 1e-5
            boxes = np.arange(found.box_first[one], found.box_first[one + 1])
            boxes = boxes[found.other[boxes] == other]
            begin = packed.distance[found.cell[boxes]] - 1e-6
            end = packed.distance[found.cell[boxes] + 1] + 1e-6
            low, high = found.low[boxes] - 1e-6, found.high[boxes] + 1e-6
            for i, j in np.argwhere(near)[::7]:
                held = (begin <= s[i]) & (s[i] <= end) & (low <= t[j]) & (t[j] <= high)
                assert held.any()


def test_boxes_hold_little_beyond_what_is_too_near() -> None:
    line = np.array([[0.0, 0, 5], [20, 0, 5]])
    across = np.array([[10.0, -10, 5.0], [10, 10, 5.0]])
    body = (0.5, 0.2, 0.5)
    courses = courses_along(["a", "b"], [flown(line, body), flown(across, body)])
    (span,) = crossings_of(courses).packed.span
    assert span == pytest.approx([8, 12, 8, 12], abs=0.3)


def test_paths_one_above_the_other_do_not_cross() -> None:
    body = (0.5, 0.2, 0.5)
    low = flown(np.array([[0.0, 0, 5], [20, 0, 5]]), body)
    for height, crosses in ((6.39, True), (6.41, False)):
        high = flown(np.array([[10.0, -10, height], [10, 10, height]]), body)
        found = crossings_of(courses_along(["a", "b"], [low, high])).packed
        assert bool(len(found.robots)) is crosses


def test_only_pairs_that_are_asked_for_are_found() -> None:
    _, courses = random_courses(4)
    every = crossings_of(courses).packed.robots.tolist()
    some = crossings_of(courses, np.array([2])).packed.robots.tolist()
    assert some == [pair for pair in every if 2 in pair]


def test_too_many_boxes_are_given_up_with_the_robots_named() -> None:
    body = (0.5, 0.2, 0.5)
    lines = [flown(np.array([[0.0, y, 5], [20, y, 5]]), body) for y in (0, 0.5)]
    courses = courses_along(["a", "b"], lines)
    with pytest.raises(GaveUpError, match="the paths of 'a' and 'b' come near each other in too"):
        spatial_crossings(courses.in_space(), None, 3)


def test_what_stays_is_one_piece_however_long_it_does() -> None:
    """What moves goes along its course by the clock: pieces of so long a stay were too many."""
    body, path = (
        (0.5, 0.2, 0.5),
        Path(CardinalSpline(np.array([[0.0, 0, 5], [20, 0, 5]])).spans, []),
    )
    law = retime(path, Limits(max_speed=2.0, max_accel=1.0))
    comes, stays, lasts = [10.0, -20.0, 5.0], [10.0, 0.0, 5.0], 1e8
    parked = MovingSolid(
        "parked", body, np.array([0.0, 10.0, lasts]), np.array([comes, stays, stays]),
        np.ones(3, np.bool_), np.zeros(3),
    )  # fmt: skip
    found = spatial_crossings(courses_among(path, law, body, [parked]), None, 1000)
    (span,) = found.span
    assert span[:2] == pytest.approx([8, 12], abs=0.3)
    assert span[2:] == pytest.approx([9, lasts], abs=0.2)


@given(seed=st.integers(0, 10_000))
def test_tangents_of_the_gap_bound_it_from_below(seed: int) -> None:
    rng = np.random.default_rng(seed)
    pair = BodyPair(float(rng.uniform(0, 2)), float(rng.uniform(0, 1)), float(rng.uniform(0, 1)))
    at, there = rng.normal(0, 3, (2, 50, 3))
    at[:5] *= 0.05
    slopes = gap_slopes(pair, at)
    assert (np.linalg.norm(slopes, axis=1) <= 1.0 + 1e-12).all()
    below = gaps_of(pair, at) + (slopes * (there - at)).sum(axis=1)
    assert (below <= gaps_of(pair, there) + 1e-9).all()
