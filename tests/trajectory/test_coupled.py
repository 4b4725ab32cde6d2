"""Limits of yaw acceleration and of axes: closed forms, dense samples, programmes as oracles."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.optimize import linprog

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.mission.world_spec import SpeedZone
from viaspline.trajectory.coupled import Stage, System
from viaspline.trajectory.limited_path import limited_path_of
from viaspline.trajectory.limits import YAW_SETTLE_S, Limits, Station
from viaspline.trajectory.retime import retime
from viaspline.trajectory.trajectory import Trajectory

seeds = st.integers(0, 2**32 - 1)
WIDE = {"max_speed": 50.0, "max_accel": 50.0}


def line(length: float, direction: tuple[float, ...] = (1.0, 0.0)) -> PiecewiseCubic:
    way = np.array(direction) / np.linalg.norm(direction)
    return PiecewiseCubic([np.linspace(0, length, 4)[:, None] * way])


def ring(seed: int) -> CardinalSpline:
    rng = np.random.default_rng(seed)
    angles = np.linspace(0, 2 * np.pi, 13)[:-1]
    points = rng.uniform(5, 15, 12)[:, None] * np.stack((np.cos(angles), np.sin(angles)), axis=1)
    return CardinalSpline(points, closed=True, knots="centripetal")


def smooth(seed: int, dimension: int = 2, count: int = 6) -> PiecewiseCubic:
    """A C2 curve: curvature is continuous."""
    return cubic(spline_through(seed, dimension, count))


def spline_through(seed: int, dimension: int = 2, count: int = 6) -> CubicSpline:
    rng = np.random.default_rng(seed)
    points = np.cumsum(rng.normal(0, 8, (count, dimension)), axis=0)
    at = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))))
    return CubicSpline(at, points)


def cubic(spline: CubicSpline) -> PiecewiseCubic:
    a, b, c, p = spline.c
    h = np.diff(spline.x)[:, None]
    inner = (p + c * h / 3, p + 2 * c * h / 3 + b * h * h / 3)
    return PiecewiseCubic(np.stack([p, *inner, p + c * h + b * h * h + a * h**3], axis=1))


def motion(
    path: PiecewiseCubic, law: Trajectory, n: int = 20_001
) -> dict[str, NDArray[np.float64]]:
    """What the robot does at many times, from the path's derivatives alone."""
    t = np.linspace(law.start_time, law.end_time, 20_001)
    distance, v, a = law.state_at(t)
    u = path.parameter(np.clip(distance, 0, path.length))
    q1, q2, q3 = (path.evaluate(u, k) for k in (1, 2, 3))
    speed = np.linalg.norm(q1, axis=1)
    rate = v / speed
    change = a / speed - (q1 * q2).sum(1) / speed**4 * v**2
    velocity = q1 * rate[:, None]
    acceleration = q2 * (rate**2)[:, None] + q1 * change[:, None]
    x, y = q1[:, 0], q1[:, 1]
    flat = x * x + y * y
    wedge = x * q2[:, 1] - y * q2[:, 0]
    turn = wedge / flat
    turn_change = (x * q3[:, 1] - y * q3[:, 0]) / flat
    turn_change -= 2 * wedge * (x * q2[:, 0] + y * q2[:, 1]) / flat**2
    return {
        "speed": v, "accel": a, "velocity": velocity, "acceleration": acceleration,
        "yaw_rate": turn * rate, "yaw_accel": turn * change + turn_change * rate**2,
        "u": u,
    }  # fmt: skip


def test_axis_limits_on_a_slanted_line_are_a_trapezoid() -> None:
    limits = Limits(**WIDE, axis_speed=[3.0, 2.0], axis_accel=[3.0, 0.8])
    law = retime(line(60.0, (3.0, 4.0)), limits)
    top, accel = 2.0 / 0.8, 0.8 / 0.8  # the second axis has 0.8 of both
    assert law.duration == pytest.approx(60 / top + top / accel, rel=1e-3)
    assert law.speeds.max() <= top * (1 + 1e-12)
    assert np.abs(law.accelerations).max() <= accel * (1 + 1e-9)


def test_a_line_in_one_dimension_may_have_them_too() -> None:
    law = retime(
        PiecewiseCubic([[[0.0], [10], [20], [30]]]), Limits(**WIDE, axis_speed=2, axis_accel=1)
    )
    assert law.duration == pytest.approx(17.0, rel=1e-3)


def test_braking_may_be_harder_than_speeding_up() -> None:
    plain = retime(line(30.0), Limits(max_speed=2, max_accel=1, max_brake=4))
    assert plain.duration == pytest.approx(2 + 0.5 + (30 - 2 - 0.5) / 2)
    assert plain.accelerations == pytest.approx([1, 0, -4])
    coupled = retime(line(30.0), Limits(max_speed=2, max_accel=1, max_brake=4, max_yaw_accel=9))
    assert coupled.duration == pytest.approx(plain.duration, rel=1e-3)


def arc(radius: float, angle: float, pieces: int = 60) -> PiecewiseCubic:
    """A circle as a C2 spline, to about 1e-8."""
    at = np.linspace(0, angle, pieces + 1)
    points = radius * np.stack((np.cos(at), np.sin(at)), axis=1)
    ends = radius * np.array([[0.0, 1.0], [-np.sin(angle), np.cos(angle)]])
    return cubic(CubicSpline(at, points, bc_type=((1, ends[0]), (1, ends[1]))))


def test_on_a_circle_the_yaw_limits_are_those_of_the_speed() -> None:
    path = arc(5.0, 3.0)
    limits = Limits(**WIDE, max_yaw_rate=0.4, max_yaw_accel=0.1)
    law = retime(path, limits)
    top, accel = 0.4 * 5.0, 0.1 * 5.0
    assert law.duration == pytest.approx(15.0 / top + top / accel, rel=3e-3)


def test_a_yaw_rate_alone_is_a_largest_speed_in_bends() -> None:
    law = retime(arc(5.0, 3.0), Limits(max_speed=9, max_accel=0.5, max_yaw_rate=0.4))
    assert law.speeds.max() == pytest.approx(2.0, rel=1e-2)
    assert law.speeds.max() <= 2.0 * (1 + 1e-4)


def test_at_the_middle_of_a_clothoid_the_yaw_acceleration_is_the_speed_alone() -> None:
    # κ = c s: |c s a + c v²| <= limit, so v = sqrt(limit / c) where s = 0
    c, limit = 0.02, 0.08
    s = np.linspace(-15, 15, 301)
    heading = c * s * s / 2
    mid = 0.5 * (heading[1:] + heading[:-1])
    points = np.concatenate(([[0, 0]], np.cumsum(0.1 * np.stack((np.cos(mid), np.sin(mid)), 1), 0)))
    path = cubic(CubicSpline(s, points))
    law = retime(path, Limits(max_speed=50, max_accel=0.5, max_yaw_accel=limit))
    assert law.speed_at(path.length / 2) == pytest.approx(np.sqrt(limit / c), rel=1e-2)


LIMITS = {
    "axes": Limits(max_speed=4, max_accel=2, axis_speed=1.5, axis_accel=0.5),
    "yaw": Limits(max_speed=4, max_accel=2, max_brake=1, max_yaw_rate=0.5, max_yaw_accel=0.3),
    "all": Limits(
        max_speed=3, max_accel=0.8, max_brake=1.2, max_lateral_accel=0.6, max_yaw_rate=0.4,
        max_yaw_accel=0.5, axis_speed=2.0, axis_accel=0.7,
    ),
    "wide": Limits(max_speed=100, max_accel=100, axis_speed=2.0, axis_accel=1.0),
}  # fmt: skip


def assert_kept(path: PiecewiseCubic, limits: Limits, law: Trajectory, slip: float) -> None:
    felt, d = motion(path, law), path.dimension
    assert felt["speed"].max() <= limits.max_speed * (1 + slip)
    assert felt["accel"].max() <= limits.max_accel * (1 + slip)
    assert -felt["accel"].min() <= limits.brake * (1 + slip)
    if (axes := limits.of_axes("axis_speed", d)).size:
        assert np.all(np.abs(felt["velocity"]) <= axes * (1 + slip))
    if (axes := limits.of_axes("axis_accel", d)).size:
        assert np.all(np.abs(felt["acceleration"]) <= axes * (1 + slip))
    if limits.max_yaw_rate is not None:
        assert np.abs(felt["yaw_rate"]).max() <= limits.max_yaw_rate * (1 + slip)
    if limits.max_yaw_accel is not None:
        assert np.abs(felt["yaw_accel"]).max() <= limits.max_yaw_accel * (1 + slip)
    if limits.max_lateral_accel is not None:
        across = felt["acceleration"] ** 2
        across = np.sqrt(np.maximum(across.sum(1) - felt["accel"] ** 2, 0.0))
        assert across.max() <= limits.max_lateral_accel * (1 + slip) + 1e-6


@pytest.mark.parametrize("name", LIMITS)
@pytest.mark.parametrize("dimension", [2, 3])
@given(seed=seeds)
@example(seed=277)  # in space it climbs so steeply that its heading turns within millimetres
@settings(deadline=None, max_examples=25)
def test_no_limit_is_exceeded_at_dense_samples(name: str, dimension: int, seed: int) -> None:
    path = smooth(seed, dimension)
    law = retime(path, LIMITS[name], [Station(0.4 * path.length, 2.0)])
    assert law.speed_at([0.0, 0.4 * path.length, path.length]).tolist() == [0, 0, 0]
    assert_kept(path, LIMITS[name], law, 1e-6 if dimension == 2 else 1e-3)


@given(seeds)
@settings(deadline=None, max_examples=15)
def test_any_curve_that_can_be_evaluated_is_driven_alike(seed: int) -> None:
    spline = spline_through(seed)

    class Plain:
        domain = (float(spline.x[0]), float(spline.x[-1]))
        evaluate = staticmethod(spline)

    path, limits = cubic(spline), LIMITS["axes"]
    law = retime(Plain(), limits)
    assert law.distances[-1] == pytest.approx(path.length, rel=1e-6)
    assert law.duration == pytest.approx(retime(path, limits).duration, rel=0.01)
    assert_kept(path, limits, law, 1e-3)
    zone = SpeedZone(polygon=[(-9, -9), (9, -9), (9, 9), (-9, 9)], max_speed_mps=0.1)
    slow = retime(Plain(), limits, zones=[zone])
    assert slow.duration == pytest.approx(retime(path, limits, zones=[zone]).duration, rel=0.01)


@given(seeds)
@settings(deadline=None, max_examples=15)
def test_the_same_path_backwards_takes_as_long(seed: int) -> None:
    path = smooth(seed)
    back = PiecewiseCubic(path.spans[::-1, ::-1])
    there, again = (retime(p, LIMITS["axes"]).duration for p in (path, back))
    assert there == pytest.approx(again, rel=2e-3)


@pytest.mark.parametrize("name", ["axes", "yaw"])
@given(seed=seeds)
@settings(deadline=None, max_examples=5)
def test_a_finer_grid_gains_little(name: str, seed: int) -> None:
    path = smooth(seed)
    usual = retime(path, LIMITS[name]).duration
    finest = retime(path, LIMITS[name], grid=12_000).duration
    assert finest * 0.998 <= usual <= finest * 1.01


def duration(squares: NDArray[np.float64], line: NDArray[np.float64]) -> float:
    v = np.sqrt(np.maximum(squares, 0.0))
    return float((2 * np.diff(line) / np.maximum(v[1:] + v[:-1], 1e-9)).sum())


@pytest.mark.parametrize(
    "seed", [0, 1, 2, *(pytest.param(seed, marks=pytest.mark.slow) for seed in (3, 4, 5))]
)
@pytest.mark.parametrize("name", ["axes", "yaw"])
def test_it_is_optimal_to_the_discretisation(name: str, seed: int) -> None:
    # the same half-planes for a programme that knows nothing of passes: minimal time is convex
    path, limits = smooth(seed, count=3), LIMITS[name]
    limited_path = limited_path_of(path, limits)
    stage = Stage(start=0.0, end=path.length, first=0.0, last=0.0, top=limits.max_speed)
    cells, cell_size = limited_path.cells(stage)
    system = System.of(cells, limits, stage, cell_size)
    squares = system.solve(0.0).squares
    n = len(squares)
    rows = np.zeros((n - 1, system.planes.shape[1], n))
    for i in range(n - 1):
        rows[i, :, i], rows[i, :, i + 1] = system.planes[i, :, 0], system.planes[i, :, 1]
    matrix, limit = rows.reshape(-1, n), system.planes[:, :, 2].ravel()
    caps = system.caps.copy()
    caps[0] = 0.0
    assert np.all(matrix @ squares <= limit * (1 + 1e-6))
    assert np.all(squares <= caps + 1e-9)
    h = np.diff(system.line)

    def cost(w: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]]:
        v = np.sqrt(w + 1e-6)
        share = -2 * h / (v[1:] + v[:-1]) ** 2
        slope = np.zeros(n)
        slope[1:] += share / (2 * v[1:])
        slope[:-1] += share / (2 * v[:-1])
        return float((2 * h / (v[1:] + v[:-1])).sum()), slope

    best = interior(cost, matrix, limit, caps, squares)
    assert duration(squares, system.line) <= duration(best, system.line) * 1.0005


def interior(cost, matrix, limit, caps, guess):  # type: ignore[no-untyped-def]
    """The minimum of a convex cost under linear limits: sequential linear programming."""
    w = 0.9 * guess
    for step in range(40):
        _, slope = cost(w)
        radius = 0.5 * np.maximum(caps, 1e-3) * 0.85**step
        bounds = np.stack((np.maximum(w - radius, 0.0), np.minimum(w + radius, caps)), axis=1)
        found = linprog(slope, A_ub=matrix, b_ub=limit, bounds=bounds, method="highs")
        assert found.status == 0
        if cost(found.x)[0] < cost(w)[0]:
            w = found.x
    return w


def test_a_jump_of_the_curvature_is_taken_slowly() -> None:
    path = CardinalSpline([[0, 0], [10, 0], [14, 8], [25, 9]])
    limits = Limits(max_speed=3, max_accel=1, max_yaw_accel=0.5)
    law = retime(path, limits)
    jumps = path.curvature_jumps()
    for joint, jump in enumerate(jumps, start=1):
        speed = float(law.speed_at(path.distance(float(joint))))
        assert 0 < speed * jump <= 0.5 * YAW_SETTLE_S * (1 + 1e-6)


def test_a_start_that_is_too_fast_brakes_and_says_how_far() -> None:
    path = arc(5.0, 6.0)
    limits = Limits(max_speed=9, max_accel=1, max_brake=2, max_yaw_rate=0.2, max_yaw_accel=0.4)
    law = retime(path, limits, start_speed=3.0)
    assert law.over_limit_until is not None
    assert law.over_limit_until == pytest.approx((3.0**2 - 1.0) / 4.0, abs=0.5)
    assert law.accelerations[0] == pytest.approx(-2.0)
    assert law.speed_at(20.0) == pytest.approx(1.0, rel=1e-3)
    with pytest.raises(GeometryError, match="can't stop at 1 m"):
        retime(path, limits, [Station(1.0)], start_speed=3.0)


@given(seeds)
@settings(deadline=None, max_examples=15)
def test_a_law_that_is_sought_again_under_way_is_the_same(seed: int) -> None:
    path = smooth(seed)
    limits = LIMITS["all"]
    law = retime(path, limits)
    here = 0.37 * path.length
    rest = retime(path, limits, start=here, start_speed=float(law.speed_at(here)))
    assert rest.over_limit_until is None
    assert rest.duration == pytest.approx(law.duration - law.time_at(here), rel=1e-2)


@pytest.mark.parametrize("scale", [1e-4, 1e4])
def test_limits_may_be_tiny_or_huge(scale: float) -> None:
    path = smooth(3)
    limits = Limits(
        max_speed=2 * scale, max_accel=scale**2, axis_accel=0.5 * scale**2, max_yaw_accel=scale**2
    )
    law = retime(path, limits)
    plain = Limits(max_speed=2, max_accel=1, axis_accel=0.5, max_yaw_accel=1)
    assert law.duration * scale == pytest.approx(retime(path, plain).duration, rel=1e-2)
    odd = retime(path, Limits(max_speed=1e9, max_accel=1e9, max_yaw_accel=1.0))
    assert 0 < odd.duration < 1e3


def test_a_cusp_and_a_corner_are_stops_for_the_axes() -> None:
    there = np.linspace(0, 9, 4)[:, None] * [1.0, 0.0]
    corner = PiecewiseCubic([there, [9.0, 0.0] + there[:, ::-1]])
    law = retime(corner, Limits(**WIDE, axis_speed=2, axis_accel=1))
    assert law.speed_at(9.0) == pytest.approx(0.0, abs=1e-6)  # the length has rounding
    back = PiecewiseCubic([there, there[::-1]])
    law = retime(back, Limits(**WIDE, axis_speed=2, axis_accel=1))
    assert law.speed_at(9.0) == pytest.approx(0.0, abs=1e-6)  # the length has rounding
    assert law.duration == pytest.approx(2 * (9 / 2 + 2), rel=1e-2)


def test_a_polyline_with_handles_of_length_zero_has_straight_cells() -> None:
    path = CardinalSpline([[0, 0], [10, 0], [20, 0]], tension=1.0)
    law = retime(path, Limits(**WIDE, axis_speed=2, axis_accel=1))
    assert law.duration == pytest.approx(12.0, rel=1e-3)


def test_a_wrong_number_of_axes_is_named() -> None:
    with pytest.raises(GeometryError, match=r"axis_speed has 3 numbers and the path 2 axes"):
        retime(line(3.0), Limits(max_speed=1, max_accel=1, axis_speed=[1, 2, 3]))
    with pytest.raises(GeometryError, match="grid is 0"):
        retime(line(3.0), Limits(max_speed=1, max_accel=1), grid=0)


@example(1)
@given(seeds)
@settings(deadline=None, max_examples=10)
def test_a_rest_is_reached_even_in_a_coupled_bend(seed: int) -> None:
    path = smooth(seed)
    stops = [Station(float(x)) for x in np.linspace(0.1, 0.9, 9) * path.length]
    law = retime(path, LIMITS["yaw"], stops)
    assert law.speed_at([stop.distance for stop in stops]).tolist() == [0.0] * 9
    assert_kept(path, LIMITS["yaw"], law, 1e-6)


@pytest.mark.parametrize("seed", [3, 5, 10212912])
def test_the_default_grid_loses_little_where_the_axes_limit(seed: int) -> None:
    path, limits = ring(seed), Limits(max_speed=3, max_accel=0.8, axis_accel=0.5)
    best = retime(path, limits, grid=30_000).duration
    law = retime(path, limits)
    assert law.duration == pytest.approx(best, rel=2e-3)
    assert law.distances.size < 3_000


def test_a_span_that_is_nothing_but_rounding_costs_no_time() -> None:
    corner = np.array([340.17, 48.64])
    step = np.array([9.0, 2.0])
    ahead = [np.linspace(corner - step, corner, 4), np.linspace(corner, corner + step, 4)]
    loop = np.array([corner] * 4)
    loop[1:3, 1] = np.nextafter(48.64, 0.0)
    limits = Limits(max_speed=3.0, max_accel=2.0, max_yaw_rate=1.0, max_yaw_accel=1.0)
    straight = retime(PiecewiseCubic(ahead), limits).duration
    looped = retime(PiecewiseCubic([ahead[0], loop, ahead[1]]), limits).duration
    assert looped == pytest.approx(straight)
