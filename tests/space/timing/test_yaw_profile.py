import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.path import Path, PathVia
from viaspline.space.timing.yaw_profile import (
    FacingAlong,
    FacingFixed,
    FacingPlace,
    YawProfile,
    yaw_profile,
)
from viaspline.space.timing.yaw_speeds import with_yaw_turns, yaw_speeds
from viaspline.trajectory.limits import Station


def flown(seed: int) -> Path:
    rng = np.random.default_rng(seed)
    vias = rng.uniform(0, 100, (int(rng.integers(2, 6)), 3))
    curve = CardinalSpline(vias, knots="chordal", tangents="continuous")
    stops = [
        PathVia(f"via {k}", tuple(at), "user", float(u), index=k)
        for k, (at, u) in enumerate(zip(vias.tolist(), curve.via_parameters, strict=True))
    ]
    return Path(curve.spans, stops)


@given(seed=st.integers(0, 10_000))
def test_a_body_that_faces_along_its_path_has_the_headings_of_the_curve(seed: int) -> None:
    path = flown(seed)
    profile = yaw_profile(path, FacingAlong())
    u = np.linspace(*path.domain, 401)
    off = profile.at(path.distance(u)) - path.heading(u)
    off = np.abs(np.remainder(off + math.pi, 2 * math.pi) - math.pi)
    assert np.median(off) < 0.01


@given(seed=st.integers(0, 10_000))
def test_what_is_looked_at_is_faced_at_its_via_point_and_not_at_the_next(seed: int) -> None:
    path = flown(seed)
    look = (40.0, 60.0)
    general = yaw_profile(path, FacingFixed(1.0))
    profile = yaw_profile(path, FacingFixed(1.0), [(0, look)])
    (via, at), (_, after) = path.stops[0], path.stops[1]
    toward = math.atan2(look[1] - via.at[1], look[0] - via.at[0])
    assert math.isclose(
        math.remainder(float(profile.at(at)) - toward, 2 * math.pi), 0, abs_tol=1e-6
    )
    assert math.isclose(float(profile.at(after)), float(general.at(after)), abs_tol=1e-9)


def test_an_upright_leg_keeps_the_heading_before_it_and_takes_the_first_one_at_the_start() -> None:
    up = [[0, 0, 0], [0, 0, 4], [0, 0, 8], [0, 0, 12]]
    east = [[0, 0, 12], [0, 4, 12], [0, 8, 12], [0, 12, 12]]
    down = [[0, 12, 12], [0, 12, 8], [0, 12, 4], [0, 12, 0]]
    profile = yaw_profile(Path([up, east, down], vias=[]), FacingAlong())
    assert np.allclose(profile.headings, math.pi / 2)
    assert profile.turns == ()


def test_a_body_that_faces_a_place_faces_it_and_keeps_its_heading_right_over_it() -> None:
    over = Path([[[0, 0, 5], [4, 0, 5], [8, 0, 5], [12, 0, 5]]], vias=[])
    profile = yaw_profile(over, FacingPlace(6.0, 0.0))
    assert np.allclose(profile.at([0.0, 5.5]), 0.0)
    assert np.isclose(abs(float(profile.at(7.0))), math.pi)


@given(seed=st.integers(0, 10_000))
def test_no_stretch_turns_faster_than_the_yaw_rate(seed: int) -> None:
    path = flown(seed)
    profile = yaw_profile(path, FacingAlong())
    slow = yaw_speeds(profile, 0.5, 10.0)
    at = np.linspace(0, path.length, 4001)
    rate = np.abs(np.diff(profile.at(at)) / np.diff(at))
    middle = 0.5 * (at[1:] + at[:-1])
    speed = np.full(len(middle), 10.0)
    for part in slow:
        speed[(middle > part.start) & (middle < part.end)] = part.speed
    inside = np.ones(len(middle), bool)
    for edge in profile.distances:
        inside &= ~((at[:-1] < edge) & (at[1:] > edge))
    assert np.all((rate * speed)[inside] <= 0.5 * (1 + 1e-6))


def test_a_turn_on_the_spot_takes_its_time_beside_a_dwell_or_alone() -> None:
    profile = YawProfile(np.array([0.0, 4, 4, 8, 8]), np.array([0.0, 0, 2, 2, -1]))
    assert profile.turns == ((4.0, 2.0), (8.0, -3.0))
    stops = with_yaw_turns((Station(4.0, 5.0, "gauge"),), profile, 0.5)
    assert [(stop.distance, stop.dwell) for stop in stops] == [(4.0, 5.0), (8.0, 6.0)]
    assert yaw_speeds(profile, None, 9.0) == ()


def test_what_is_looked_at_is_faced_on_arrival_where_the_path_turns_back() -> None:
    out = [[0, 0, 5], [4, 0, 5], [8, 0, 5], [12, 0, 5]]
    back = out[::-1]
    ends = [(0, (0, 0, 5)), (1, (12, 0, 5)), (2, (0, 0, 5))]
    vias = [PathVia(f"via {k}", at, "user", float(k), index=k) for k, at in ends]
    profile = yaw_profile(Path([out, back], vias), FacingAlong(), [(1, (12.0, -3.0))])
    assert np.allclose(
        profile.at([0.0, 6.0, 12.0 - 1e-9, 12.0]), [0, -0.25 * math.pi] + 2 * [-math.pi / 2]
    )
    assert profile.turns == ()
    assert math.isclose(
        math.remainder(float(profile.at(24.0)) - math.pi, 2 * math.pi), 0, abs_tol=1e-9
    )
