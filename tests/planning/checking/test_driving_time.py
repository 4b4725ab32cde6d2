"""How long a path takes, as far as its shape tells, beside the time law."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize_scalar

import viaspline as vs
from viaspline.mission.robot_parts import RobotSpec
from viaspline.planning.checking.driving_time import driving_time, straight_time
from viaspline.planning.problem.path_pace import Pace
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.retime import retime

seeds = st.integers(0, 10_000)
PACE = Pace(speed=3.0, accel=1.0, brake=0.7, lateral=0.8)


def rests(path: vs.PiecewiseCubic) -> np.ndarray:
    stands = np.zeros(len(path.spans) + 1, np.bool_)
    stands[[0, -1]] = True
    return stands


@settings(max_examples=40, deadline=None)
@given(seeds, st.sampled_from([math.inf, 0.3]))
def test_it_is_the_time_of_the_exact_law_to_a_part_in_a_hundred(seed: int, rate: float) -> None:
    points = np.cumsum(np.random.default_rng(seed).uniform(5, 30, (8, 2)), axis=0)
    curve = vs.CardinalSpline(points, knots="chordal", tangents="continuous")
    pace = Pace(speed=3.0, accel=1.0, brake=0.7, lateral=0.8, yaw_rate=rate)
    limits = Limits(
        max_speed=3.0, max_accel=1.0, max_brake=0.7, max_lateral_accel=0.8,
        max_yaw_rate=None if math.isinf(rate) else rate,
    )  # fmt: skip
    exact = retime(curve, limits).duration
    assert driving_time(np.array(curve.spans), pace, rests(curve)) == pytest.approx(exact, rel=1e-2)


@given(st.floats(0.01, 500.0))
def test_a_straight_line_takes_what_speeding_up_going_on_and_slowing_down_take(
    length: float,
) -> None:
    line = np.array([[[0, 0], [length / 3, 0], [2 * length / 3, 0], [length, 0]]], float)
    stands = np.array([True, True])
    assert driving_time(line, PACE, stands) == pytest.approx(straight_time(length, PACE), rel=1e-9)


def test_where_the_robot_stands_it_takes_longer() -> None:
    curve = vs.CardinalSpline([(0, 0), (30, 0), (60, 0)])
    halt = rests(curve)
    halt[1] = True
    through = driving_time(np.array(curve.spans), PACE, rests(curve))
    halted = driving_time(np.array(curve.spans), PACE, halt)
    assert halted - through == pytest.approx(1.5 / 1.0 + 1.5 / 0.7, rel=1e-2)


def corner_time(radius: float, turn: float, kept: float, pace: Pace) -> float:
    """Of a corner between long lines, beside the hugged one: geometry, not the closed form."""
    speed = min(pace.speed, math.sqrt(pace.lateral * radius))
    tip = (radius - kept) * (1 / math.cos(turn / 2) - 1)
    length = 2 * math.sin(turn / 2) * tip
    length -= (2 * math.tan(turn / 2) - turn) * (radius - kept)
    slowed = sum((pace.speed - speed) ** 2 / (2 * pace.speed * a) for a in (pace.accel, pace.brake))
    return length / pace.speed + slowed + radius * turn * (1 / speed - 1 / pace.speed)


@given(st.floats(0.05, 2.5), st.floats(0.0, 5.0))
def test_the_radius_of_a_corner_is_the_fastest_one(turn: float, kept: float) -> None:
    (radius,) = PACE.corner_radii(np.array([turn]), np.array([kept]), np.array([PACE.speed]))
    best = minimize_scalar(
        lambda r: corner_time(r, turn, kept, PACE), bounds=(max(kept, 0.01), 12.0), method="bounded"
    )
    assert radius >= kept
    assert corner_time(radius, turn, kept, PACE) <= best.fun + 0.02 * max(best.fun, 0.1)


def test_without_a_limit_across_the_path_what_is_kept_is_hugged() -> None:
    pace = Pace(speed=3.0, accel=1.0, brake=1.0, lateral=math.inf)
    turns, kept, speeds = np.array([1.0, -2.0]), np.array([0.0, 2.0]), np.full(2, pace.speed)
    assert pace.corner_radii(turns, kept, speeds).tolist() == [0.0, 2.0]


@settings(max_examples=40, deadline=None)
@given(seeds)
def test_in_zones_it_takes_about_as_long_as_the_law_says(seed: int) -> None:
    rng = np.random.default_rng(seed)
    curve = vs.CardinalSpline(rng.uniform(0, 60, (rng.integers(2, 7), 2)), tension=0.2)
    zones = []
    for _ in range(rng.integers(1, 4)):
        (x, y), (w, h) = rng.uniform(0, 50, 2), rng.uniform(2, 30, 2)
        corners = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]
        zones.append(vs.SpeedZone(polygon=corners, max_speed_mps=rng.uniform(0.2, 4.0)))
    robot = RobotSpec(max_speed_mps=3.0, max_accel_mps2=1.0, max_brake_mps2=0.7)
    limits = Limits(max_speed=3.0, max_accel=1.0, max_brake=0.7)
    exact = retime(curve, limits, zones=zones).duration
    pace = replace(Pace.of(robot, zones), lateral=math.inf)
    found = driving_time(np.array(curve.spans), pace, rests(curve))
    assert found == pytest.approx(exact, rel=1e-2)
