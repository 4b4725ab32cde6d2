"""Corners of a path, and how long a robot stays at each of them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.machine.turns_on_spot import corners, with_turns
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.spot_turning import SpotTurning
from viaspline.trajectory.limits import Station


@pytest.fixture(scope="module")
def square() -> CardinalSpline:
    return CardinalSpline([(0, 0), (4, 0), (4, 4), (0, 4)], tension=1.0)


def test_every_corner_of_a_polyline_is_found_with_its_angle(square: CardinalSpline) -> None:
    at, angles = corners(square)
    assert at == pytest.approx([4.0, 8.0])
    assert angles == pytest.approx([math.pi / 2, math.pi / 2])


def test_a_smooth_curve_has_no_corner(bends: Any) -> None:
    assert corners(bends)[0].size == 0


def test_a_robot_without_a_drive_turns_as_fast_as_its_yaw_rate_allows(
    square: CardinalSpline,
) -> None:
    robot = RobotSpec(max_yaw_rate_degps=45)
    (stop, _) = with_turns(square, SpotTurning.of(robot), [])
    assert (stop.distance, stop.dwell) == (pytest.approx(4.0), pytest.approx(2.0))
    assert with_turns(square, SpotTurning.of(RobotSpec()), []) == []


@given(
    at=st.floats(0.01, 0.99),
    ahead=st.tuples(st.floats(-3, 3), st.floats(-3, 3)),
    bend=st.tuples(st.floats(-3, 3), st.floats(-3, 3)),
    far=st.floats(-1e3, 1e3),
)
def test_a_cusp_inside_of_a_span_is_a_turn_by_half_a_turn(
    at: float, ahead: tuple[float, float], bend: tuple[float, float], far: float
) -> None:
    a, b = np.array(ahead), np.array(bend)
    assume(np.linalg.norm(a + at * b) > 0.1)  # P' = (w - at) (a + b w)
    places = (0.0, 1 / 3, 2 / 3, 1.0)
    integral = [(a - at * b) * w * w / 2 - at * a * w + b * w**3 / 3 for w in places]
    p0, p1, p2, p3 = (point + far for point in integral)
    c1 = (-5 * p0 + 18 * p1 - 9 * p2 + 2 * p3) / 6
    c2 = (2 * p0 - 9 * p1 + 18 * p2 - 5 * p3) / 6
    path = PiecewiseCubic([[p0, c1, c2, p3]])
    found, angles = corners(path)
    nearest = int(np.abs(found - path.distance(at)).argmin())
    assert found[nearest] == pytest.approx(path.distance(at), abs=1e-6)
    assert angles[nearest] == math.pi


def test_a_curve_that_only_comes_to_rest_within_a_span_does_not_turn() -> None:
    assert corners(PiecewiseCubic([[(0, 0), (1, 0), (1, 0), (2, 0)]]))[0].size == 0  # P' is above 0
    still = PiecewiseCubic([[(0, 0), (1, 0), (0, 0), (1, 0)]])  # P' = 3 (1 - 2w)², as flat as can
    assert corners(still)[0].size == 0


def test_a_stay_that_is_long_enough_serves_for_the_turn(
    square: CardinalSpline, robot_of: Any
) -> None:
    turning = SpotTurning.of(robot_of("differential"))
    stops = with_turns(square, turning, [Station(4.0, 60.0, "dock")])
    assert [(stop.distance, stop.name) for stop in stops] == [
        (pytest.approx(4.0), "dock"), (pytest.approx(8.0), "turn"),
    ]  # fmt: skip
    short = with_turns(square, turning, [Station(4.0, 0.5, "dock")])
    assert sum(s.dwell for s in short[:2]) == pytest.approx(turning.time(math.pi / 2))


def test_corners_that_lie_behind_are_left_out(square: CardinalSpline, robot_of: Any) -> None:
    stops = with_turns(square, SpotTurning.of(robot_of("differential")), [], start=5.0)
    assert np.array([stop.distance for stop in stops]) == pytest.approx([8.0])
