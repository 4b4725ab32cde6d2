"""The proof that robots in space stay apart, against what is seen every few milliseconds."""

from __future__ import annotations

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.path import Path
from viaspline.fleet.courses import FleetPath, courses_along
from viaspline.fleet.fleet_certificate import certify_fleet
from viaspline.fleet.fleet_laws import static_laws
from viaspline.fleet.timing.time_paths import standing_laws
from viaspline.space.meeting.spatial_separation import nearest_in_space
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.retime import retime

BODIES = ((0.5, 0.2, 0.1), (0.0, 0.0, 0.4), (0.8, 0.5, 0.0))


def straight(start: tuple[float, ...], goal: tuple[float, ...]) -> Path:
    return Path(CardinalSpline(np.array([start, goal], float)).spans, vias=[])


@settings(max_examples=25)
@given(seed=st.integers(0, 10_000))
def test_the_bound_is_below_what_is_seen_and_little_below(seed: int) -> None:
    rng = np.random.default_rng(seed)
    paths = [
        Path(CardinalSpline(rng.uniform((0, 0, 0), (15, 15, 9), (4, 3))).spans, vias=[])
        for _ in BODIES
    ]
    laws = [
        retime(path, Limits(max_speed=float(rng.uniform(1, 4)), max_accel=2),
               [Station(0.4 * path.length, dwell=float(rng.uniform(0, 3)))],
               start_time=float(rng.uniform(0, 4)))
        for path in paths
    ]  # fmt: skip
    courses = courses_along(
        ["a", "b", "c"],
        [FleetPath(path, law.distances, body[0] + body[2], body)
         for path, law, body in zip(paths, laws, BODIES, strict=True)],
    )  # fmt: skip
    proven = certify_fleet(courses, static_laws(courses, laws), required=1.0)
    times = np.arange(0, max(law.end_time for law in laws) + 0.1, 0.004)
    least = np.inf
    for one, other in combinations(range(3), 2):
        off = np.subtract(*(
            np.asarray(paths[k].at_distance(np.clip(laws[k].distance_at(times), 0, None)))
            for k in (one, other)
        ))  # fmt: skip
        r, h, m = np.add(BODIES[one], BODIES[other])
        level = np.maximum(np.hypot(off[:, 0], off[:, 1]) - r, 0.0)
        gap = np.hypot(level, np.maximum(np.abs(off[:, 2]) - h, 0.0)) - m
        least = min(least, float(gap.min()))
    assert proven.separation - 1.0 <= least + 1e-9
    assert proven.separation - 1.0 >= least - 0.06
    assert proven.pair is not None
    assert proven.at is not None
    assert len(proven.at[0]) == 3


def test_robots_that_hover_above_each_other_are_their_heights_apart() -> None:
    paths = [straight((0, 0, z), (1, 0, z)) for z in (5, 9)]
    laws = [retime(path, Limits(max_speed=1, max_accel=1)) for path in paths]
    body = (0.5, 0.25, 0.5)
    courses = courses_along(
        ["a", "b"], [FleetPath(p, w.distances, 1.0, body) for p, w in zip(paths, laws, strict=True)]
    )
    found = nearest_in_space(courses.in_space(), static_laws(courses, laws).packed)
    assert found.bound == pytest.approx(4 - 0.5 - 1.0, abs=1e-9)


def test_robots_without_a_law_play_no_part() -> None:
    path = straight((0, 0, 5), (9, 0, 5))
    one = FleetPath(path, np.array([0.0, path.length]), 1.0, (0.5, 0.2, 0.5))
    courses = courses_along(["a", "b"], [one, one])
    laws = standing_laws(courses)
    assert nearest_in_space(courses.in_space(), laws.packed).pair == (-1, -1)
    assert certify_fleet(courses, laws, 1.0).pair is None


def test_robots_that_stand_at_one_place_for_ever_are_not_apart() -> None:
    path = straight((0, 0, 5), (9, 0, 5))
    one = FleetPath(path, np.array([0.0, path.length]), 1.0, (0.5, 0.2, 0.5))
    courses = courses_along(["a", "b"], [one, one])
    laws = standing_laws(courses)
    laws.packed.is_timed[:] = True
    found = nearest_in_space(courses.in_space(), laws.packed)
    assert found.pair == (0, 1)
    assert found.bound == pytest.approx(-1.0)


def test_who_has_left_is_in_nobodys_way() -> None:
    paths = [straight((0, 0, 5), (9, 0, 5)), straight((9, 0, 5), (9, 9, 5))]
    laws = [retime(paths[0], Limits(max_speed=3, max_accel=3)),
            retime(paths[1], Limits(max_speed=3, max_accel=3), start_time=-40.0)]  # fmt: skip
    body = (0.5, 0.2, 0.5)
    courses = courses_along(
        ["a", "b"], [FleetPath(p, w.distances, 1.0, body) for p, w in zip(paths, laws, strict=True)]
    )
    there = static_laws(courses, laws)
    last = courses.packed.first[2] - 1
    there.packed.leave[last] = there.packed.arrive[last]
    found = nearest_in_space(courses.in_space(), there.packed)
    assert found.bound == pytest.approx(9 - 1.0 - 1.0, abs=2e-3)
