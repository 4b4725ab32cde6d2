"""A limit of the jerk: closed forms, dense samples, a programme as reference, and stops."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq, linprog

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.mission.world_spec import SpeedZone
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.retime import retime
from viaspline.trajectory.slow_zones import Slow

seeds = st.integers(0, 2**32 - 1)


def line(length: float) -> PiecewiseCubic:
    return PiecewiseCubic([np.linspace(0, length, 4)[:, None] * [1.0, 0.0]])


def smooth(seed: int) -> PiecewiseCubic:
    rng = np.random.default_rng(seed)
    points = np.cumsum(rng.normal(0, 8, (5, 2)), axis=0)
    at = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))))
    a, b, c, p = CubicSpline(at, points).c
    h = np.diff(at)[:, None]
    inner = (p + c * h / 3, p + 2 * c * h / 3 + b * h * h / 3)
    return PiecewiseCubic(np.stack([p, *inner, p + c * h + b * h * h + a * h**3], axis=1))


def change(low: float, high: float, accel: float, jerk: float) -> tuple[float, float]:
    """Time and distance of the fastest change of speed that begins and ends evenly."""
    rise = high - low
    time = rise / accel + accel / jerk if rise > accel**2 / jerk else 2 * np.sqrt(rise / jerk)
    return time, time * (low + high) / 2


def rest_to_rest(length: float, top: float, accel: float, jerk: float) -> float:
    time, room = change(0.0, top, accel, jerk)
    if 2 * room <= length:
        return 2 * time + (length - 2 * room) / top
    peak = brentq(lambda v: 2 * change(0.0, v, accel, jerk)[1] - length, 1e-9, top)
    return 2 * change(0.0, peak, accel, jerk)[0]


@pytest.mark.parametrize("length", [0.1, 1.0, 30.0, 300.0])
@pytest.mark.parametrize("jerk", [0.1, 1.0, 20.0])
def test_a_line_is_within_a_percent_of_its_closed_form(length: float, jerk: float) -> None:
    law = retime(line(length), Limits(max_speed=2, max_accel=1, max_jerk=jerk))
    best = rest_to_rest(length, 2.0, 1.0, jerk)
    assert best * (1 - 1e-9) <= law.duration <= best * 1.01


@given(beyond=st.floats(1e-5, 9.0), jerk=st.floats(0.3, 5.0))
@settings(max_examples=10, deadline=None)
@example(beyond=0.002, jerk=1.0)
def test_a_way_back_from_a_cusp_takes_about_as_long_as_two_lines(
    beyond: float, jerk: float
) -> None:
    """Cells of a path that turns back inside of a span are down to 1e-13 m long beside the cusp."""
    path = CardinalSpline([(0, 0), (10, 0), (beyond, 0)])
    limits = Limits(max_speed=2, max_accel=1, max_jerk=jerk, max_yaw_rate=1.0)
    law = retime(path, limits)
    far = 0.5 * (path.length + beyond)
    best = sum(rest_to_rest(length, 2.0, 1.0, jerk) for length in (far, path.length - far))
    assert best * (1 - 1e-9) <= law.duration <= best * 1.15


def test_a_slow_zone_is_within_a_percent_of_its_closed_form() -> None:
    zone = SpeedZone(polygon=((15, -1), (25, -1), (25, 1), (15, 1)), max_speed_mps=0.5)
    law = retime(line(40.0), Limits(max_speed=2, max_accel=1, max_jerk=1), zones=[zone])
    up, down = change(0.0, 2.0, 1.0, 1.0), change(0.5, 2.0, 1.0, 1.0)
    best = 20.0 + 2 * (up[0] + down[0] + (15 - up[1] - down[1]) / 2.0)
    assert law.duration <= best * 1.001  # it may still be braking at the edge, and is faster then
    rough = retime(line(40.0), Limits(max_speed=2, max_accel=1), zones=[zone])
    assert law.duration > rough.duration
    assert law.speed_at(np.linspace(15, 25, 99)).max() <= 0.5 * (1 + 1e-9)


@given(st.integers(0, 10_000))
@settings(deadline=None, max_examples=25)
def test_no_slow_part_is_driven_faster_than_it_allows_up_to_its_very_ends(seed: int) -> None:
    random = np.random.default_rng(seed)
    path = CardinalSpline(np.cumsum(random.uniform(-3, 6, (5, 2)), axis=0))
    limits = Limits(max_speed=2, max_accel=1, max_jerk=random.uniform(0.3, 3))
    a, b, c, d = np.sort(random.uniform(1, path.length - 1, 4)).tolist()
    slow = [Slow(a, b, 0.5), Slow(b, c, random.uniform(0.3, 1.8)), Slow(c + 0.3 * (d - c), d, 1.0)]
    law = retime(path, limits, slow=slow)
    for part in slow:
        within = np.linspace(part.start, part.end, 2001)[1:-1]
        assert law.speed_at(within).max() <= part.speed * (1 + 1e-9)


LIMITS = {
    "bends": Limits(max_speed=3, max_accel=0.8, max_brake=1.2, max_lateral_accel=0.5, max_jerk=0.6),
    "axes": Limits(max_speed=4, max_accel=2, axis_speed=1.5, axis_accel=0.5, max_jerk=0.5),
    "yaw": Limits(max_speed=4, max_accel=2, max_yaw_rate=0.5, max_yaw_accel=0.3, max_jerk=0.5),
}


@pytest.mark.parametrize("name", LIMITS)
@given(seed=seeds)
@settings(deadline=None, max_examples=4)
def test_no_limit_is_exceeded_at_dense_samples(name: str, seed: int) -> None:
    path, limits = smooth(seed), LIMITS[name]
    law = retime(path, limits, [Station(0.4 * path.length, 2.0)])
    assert law.speed_at([0.0, 0.4 * path.length, path.length]).tolist() == [0, 0, 0]
    t = np.linspace(0, law.end_time, 20_001)
    s, v, a = law.state_at(t)
    assert np.abs(np.diff(a) / np.diff(t)).max() <= limits.max_jerk * (1 + 1e-6)
    assert v.max() <= limits.max_speed * (1 + 1e-6)
    assert a.max() <= limits.max_accel * (1 + 1e-6)
    assert -a.min() <= limits.brake * (1 + 1e-6)
    u = path.parameter(np.clip(s, 0, path.length))
    q1, q2, q3 = (path.evaluate(u, k) for k in (1, 2, 3))
    speed = np.linalg.norm(q1, axis=1)
    kappa = path.curvature(u)
    if name == "bends":
        assert (v * v * np.abs(kappa)).max() <= 0.5 * (1 + 1e-6)
    if name == "axes":
        rate, more = v / speed, a / speed - (q1 * q2).sum(1) / speed**4 * v**2
        assert np.abs(q1 * rate[:, None]).max() <= 1.5 * (1 + 1e-6)
        assert np.abs(q2 * (rate**2)[:, None] + q1 * more[:, None]).max() <= 0.5 * (1 + 1e-6)
    if name == "yaw":
        bend = (q1[:, 0] * q3[:, 1] - q1[:, 1] * q3[:, 0]) / speed**3
        bend = (bend - 3 * kappa * (q1 * q2).sum(1) / speed**2) / speed
        assert np.abs(kappa * v).max() <= 0.5 * (1 + 1e-6)
        assert np.abs(kappa * a + bend * v * v).max() <= 0.3 * (1 + 1e-6)


@pytest.mark.parametrize("name", LIMITS)
def test_times_distances_and_speeds_belong_together(name: str) -> None:
    path = smooth(5)
    law = retime(path, LIMITS[name], [Station(0.3 * path.length, 1.0)])
    t = np.linspace(0, law.end_time, 400_001)
    s, v, a = law.state_at(t)
    assert np.all(np.diff(s) >= -1e-12)
    gone, faster = (0.5 * (x[1:] + x[:-1]) * np.diff(t) for x in (v, a))
    np.testing.assert_allclose(np.diff(s), gone, rtol=0, atol=1e-8)
    np.testing.assert_allclose(np.diff(v), faster, rtol=0, atol=1e-8)
    places = np.linspace(0, path.length, 3001)
    assert law.distance_at(law.time_at(places)) == pytest.approx(places, abs=1e-6)
    assert law.state_at(law.time_at(places[1:-1]))[1] == pytest.approx(
        law.speed_at(places[1:-1]), abs=1e-5
    )
    part = law.until(0.2 * path.length)
    assert part.distances[-1] == pytest.approx(0.3 * path.length)
    assert part.distance_at(3.0) == law.distance_at(3.0)


def reference(path: PiecewiseCubic, limits: Limits, n: int = 480) -> float:
    """Duration by sequential linear programming on a plain grid of w and a, from below."""
    assert limits.max_jerk is not None
    h = path.length / n
    s = np.linspace(0, path.length, n + 1)
    cap = limits.max_lateral_accel / np.maximum(np.abs(path.curvature(path.parameter(s))), 1e-9)
    cap = np.minimum(cap, limits.max_speed**2)
    cap[[1, -2]] = np.minimum(cap[[1, -2]], (4.5 * h * h * limits.max_jerk) ** (2 / 3))
    cap[[0, -1]] = 0.0
    slope = (np.eye(n + 1)[1:] - np.eye(n + 1)[:-1]) / (2 * h)
    bend = np.diff(slope, axis=0) / h
    w, best = 0.02 * np.minimum(cap, (s * (path.length - s)) / path.length), np.inf
    for _ in range(60):
        v = np.sqrt(w[1:-1])
        room = limits.max_jerk * (1.5 / v)  # J / sqrt(w) is convex: its tangent is below it
        tangent = np.zeros((n - 1, n + 1))
        tangent[np.arange(n - 1), np.arange(1, n)] = 0.5 * limits.max_jerk / v**3
        rows = np.concatenate((slope, -slope, bend + tangent, tangent - bend))
        bounds = (np.full(n, limits.max_accel), np.full(n, limits.brake), room, room)
        found = linprog(
            -1.0 / np.maximum(w, 1e-6) ** 1.5, A_ub=rows, b_ub=np.concatenate(bounds),
            bounds=np.stack((np.maximum(0.3 * w, 0.0), np.minimum(3.0 * w + 1e-9, cap)), axis=1),
        )  # fmt: skip
        assert found.status == 0
        w = np.maximum(found.x, 1e-12)
        w[[0, -1]] = 0.0
        time = float((2 * h / (np.sqrt(w[1:]) + np.sqrt(w[:-1]))).sum())
        if abs(time - best) < 1e-5 * time:
            break
        best = time
    return best


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_it_is_hardly_slower_than_a_programme_on_a_plain_grid(seed: int) -> None:
    path, limits = smooth(seed), LIMITS["bends"]
    law = retime(path, limits)
    assert law.duration <= reference(path, limits) * 1.05
    assert law.duration >= retime(path, replace(limits, max_jerk=None)).duration * 0.99


def test_a_large_jerk_is_none_and_the_way_back_takes_as_long() -> None:
    path = smooth(7)
    free = replace(LIMITS["bends"], max_jerk=None, max_brake=None)
    rough = retime(path, replace(free, max_jerk=50.0)).duration
    assert rough == pytest.approx(retime(path, free).duration, rel=0.05)
    even = replace(LIMITS["bends"], max_brake=None)
    back = PiecewiseCubic(path.spans[::-1, ::-1])
    assert retime(path, even).duration == pytest.approx(retime(back, even).duration, rel=1e-2)


def test_under_way_the_jerk_is_limited_from_the_start_on() -> None:
    limits = Limits(max_speed=2, max_accel=1, max_jerk=1)
    law = retime(line(60.0), limits, [Station(20.0, 1.0)], start=5.0, start_speed=2.0)
    assert law.speeds[0] == 2.0
    later = law.duration - law.time_at(20.0) - 1.0
    assert later == pytest.approx(rest_to_rest(40.0, 2.0, 1.0, 1.0), rel=0.01)
    time, room = change(0.0, 2.0, 1.0, 1.0)
    assert law.time_at(20.0) == pytest.approx(time + (15.0 - room) / 2.0, rel=0.01)
    assert law.over_limit_until is law.over_jerk_until is None
    whole = retime(line(60.0), limits, start_speed=2.0, end_speed=2.0)
    assert whole.duration == pytest.approx(30.0, rel=0.01)


@pytest.mark.parametrize("name", LIMITS)
@pytest.mark.parametrize("part", [0.2, 0.45, 0.6])
def test_a_law_that_takes_over_goes_on_in_speed_and_acceleration(name: str, part: float) -> None:
    path, limits = smooth(2), LIMITS[name]
    old = retime(path, limits)
    now = part * old.duration
    s, v, a = (float(x) for x in old.state_at(now))
    law = retime(path, limits, start=s, start_speed=v, start_accel=a, start_time=now, replaces=old)
    over = max(law.over_limit_until or s, law.over_jerk_until or s)
    assert over - s < 0.2  # the bounds of its first stretches may be wider than what was driven
    assert law.state_at(now) == pytest.approx((s, v, a))
    assert law.end_time == pytest.approx(old.end_time, rel=0.02)
    t = np.linspace(now - 1.0, law.end_time, 40_001)
    accel = np.where(t < now, old.state_at(t)[2], law.state_at(t)[2])
    jerks = np.abs(np.diff(accel) / np.diff(t))
    said = (t[1:] >= now) & (t[:-1] <= float(law.time_at(over))) & (over > s)
    assert jerks[~said].max() <= limits.max_jerk * (1 + 1e-4)


def test_a_robot_without_room_for_its_jerk_says_how_far() -> None:
    limits = Limits(max_speed=2, max_accel=1, max_jerk=1)
    law = retime(line(2.2), limits, start_speed=2.0)  # with the jerk it takes 3 m to stop
    assert law.over_jerk_until is not None
    assert law.speeds[-1] == 0.0
    assert law.accelerations.min() >= -1.0 - 0.02


@pytest.mark.parametrize("jerk", [1e3, 1e9])
def test_a_jerk_that_no_motor_reaches_makes_no_difference(jerk: float) -> None:
    curve = CardinalSpline([(0, 0), (10, 5), (30, 0)], knots="chordal", tangents="continuous")
    limits = {"max_speed": 2.0, "max_accel": 1.0}
    plain = retime(curve, Limits(**limits)).duration
    assert retime(curve, Limits(**limits, max_jerk=jerk)).duration < 1.01 * plain
