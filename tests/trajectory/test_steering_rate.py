"""The steering rate in the time law, against dense samples of the steering angle."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.trajectory.lap import retime_lap
from viaspline.trajectory.limits import YAW_SETTLE_S, Limits
from viaspline.trajectory.retime import retime

LIMITS = Limits(max_speed=3, max_accel=1, max_steer_rate=0.3, wheelbase=1.2)
PLAIN = Limits(max_speed=3, max_accel=1)


def smooth(seed: int) -> PiecewiseCubic:
    """A C2 curve: curvature is continuous."""
    rng = np.random.default_rng(seed)
    points = np.cumsum(rng.normal(0, 8, (6, 2)), axis=0)
    at = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))))
    a, b, c, p = CubicSpline(at, points).c
    h = np.diff(at)[:, None]
    inner = (p + c * h / 3, p + 2 * c * h / 3 + b * h * h / 3)
    return PiecewiseCubic(np.stack([p, *inner, p + c * h + b * h * h + a * h**3], axis=1))


@given(seed=st.integers(0, 2**32 - 1))
@settings(deadline=None, max_examples=25)
def test_the_steering_never_turns_faster_than_it_can(seed: int) -> None:
    path = smooth(seed)
    law = retime(path, LIMITS)
    u = np.linspace(*path.domain, 40_001)
    angle = np.arctan(1.2 * path.curvature(u))
    s = np.asarray(path.distance(u))
    slope = np.abs(np.diff(angle) / np.diff(s))
    speed = np.maximum(law.speed_at(s[1:]), law.speed_at(s[:-1]))
    assert (slope * speed).max() <= 0.3 * (1 + 1e-3)  # differences over a jump of the slope
    assert law.duration >= retime(path, PLAIN).duration * (1 - 1e-9)


@pytest.mark.parametrize("seed", range(5))
def test_the_bound_is_reached_to_a_tenth(seed: int) -> None:
    path = smooth(seed)
    law = retime(path, LIMITS)
    u = np.linspace(*path.domain, 40_001)
    angle, s = np.arctan(1.2 * path.curvature(u)), np.asarray(path.distance(u))
    rate = np.abs(np.diff(angle) / np.diff(s)) * law.speed_at(0.5 * (s[1:] + s[:-1]))
    assert rate.max() > 0.3 * 0.9


def test_where_the_curvature_jumps_the_robot_is_slow_enough_for_the_wheels() -> None:
    path = CardinalSpline([[0, 0], [8, 6], [16, 0], [24, 6]])
    law = retime(path, LIMITS)
    for k in (1, 2):
        near = np.asarray(path.curvature(k + np.array([-1e-9, 1e-9])))
        turn = abs(float(np.diff(np.arctan(1.2 * near))[0]))
        assert turn > 0.05
        speed = float(law.speed_at(path.distance(float(k))))
        assert speed * turn / 0.3 <= 3 * YAW_SETTLE_S * (1 + 1e-6)


def test_a_fast_steering_is_none_and_one_without_a_wheelbase_is_refused() -> None:
    path = smooth(1)
    fast = Limits(max_speed=3, max_accel=1, max_steer_rate=1e4, wheelbase=1.2)
    assert retime(path, fast).duration == pytest.approx(retime(path, PLAIN).duration, rel=1e-3)
    with pytest.raises(GeometryError, match="wheelbase"):
        Limits(max_speed=3, max_accel=1, max_steer_rate=0.3)


def test_laps_keep_the_steering_rate_at_their_seam() -> None:
    angles = np.linspace(0, 2 * np.pi, 9)[:-1]
    radii = np.array([8, 12, 8, 12, 8, 12, 8, 12.0])
    points = radii[:, None] * np.stack((np.cos(angles), np.sin(angles)), axis=1)
    path = CardinalSpline(points, closed=True)
    law = retime_lap(path, LIMITS)
    ends = np.asarray(path.curvature(np.array([path.domain[1] - 1e-9, 1e-9])))
    turn = abs(float(np.diff(np.arctan(1.2 * ends))[0]))
    assert law.speeds[0] <= 3 * YAW_SETTLE_S * 0.3 / turn * (1 + 1e-6)
