"""The time law against closed forms, against a dense reference, and by its properties."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.path import Path
from viaspline.errors import GeometryError
from viaspline.mission.robot_parts import RobotSpec
from viaspline.mission.sensor_spec import Sensor
from viaspline.trajectory.limits import Limits, Station, stopping_speed
from viaspline.trajectory.retime import braking, retime

seeds = st.integers(0, 2**32 - 1)
LIMITS = Limits(max_speed=2.0, max_accel=1.0)


def line(length: float, pieces: int = 3) -> Path:
    xs = np.linspace(0, length, 3 * pieces + 1)
    points = np.stack((xs, 0 * xs), axis=1)
    return Path([points[3 * k : 3 * k + 4] for k in range(pieces)], vias=[])


def curve(seed: int, count: int = 6) -> CardinalSpline:
    rng = np.random.default_rng(seed)
    return CardinalSpline(np.cumsum(rng.normal(0, 8, (count, 2)), axis=0), knots="centripetal")


def test_a_long_line_is_a_trapezoid() -> None:
    law = retime(line(30.0), LIMITS)
    assert law.times == pytest.approx([0, 2, 15, 17])
    assert law.distances == pytest.approx([0, 2, 28, 30])
    assert law.speeds == pytest.approx([0, 2, 2, 0])
    assert law.accelerations == pytest.approx([1, 0, -1])
    assert law.duration == pytest.approx(30 / 2 + 2 / 1)


def test_a_short_line_is_a_triangle() -> None:
    law = retime(line(1.0), LIMITS)
    assert law.duration == pytest.approx(2 * np.sqrt(1.0))
    assert law.speeds.max() == pytest.approx(1.0)


def test_a_station_is_a_stop_with_its_dwell() -> None:
    law = retime(line(30.0), LIMITS, [Station(10.0, dwell=5.0, name="pump")])
    assert law.duration == pytest.approx((10 / 2 + 2) + 5 + (20 / 2 + 2))
    assert law.speed_at(10.0) == 0.0
    assert law.time_at(10.0) == pytest.approx(7.0)
    distance, speed, acceleration = law.state_at([7.0, 9.0, 12.0])
    assert distance == pytest.approx([10, 10, 10])
    assert speed == pytest.approx([0, 0, 0])
    assert acceleration == pytest.approx([0, 0, 1])


@pytest.mark.parametrize("jerk", [None, 0.5])
def test_a_law_knows_nothing_of_no_place_and_of_no_instant(jerk: float | None) -> None:
    law = retime(line(30.0), Limits(max_speed=2.0, max_accel=1.0, max_jerk=jerk))
    assert np.isnan([law.time_at(np.nan), law.speed_at(np.nan), *law.state_at(np.nan)[:2]]).all()
    assert np.isnan(law.time_at([10.0, np.nan])).tolist() == [False, True]


def test_a_station_may_be_the_start_and_the_goal() -> None:
    stations = [Station(0.0, 3.0), Station(30.0, 4.0)]
    law = retime(line(30.0), LIMITS, stations)
    assert law.duration == pytest.approx(3 + 17 + 4)
    assert law.distance_at(2.9) == 0.0
    assert law.distance_at([20.0, 24.0, 99.0]) == pytest.approx([30, 30, 30])


def test_a_stop_without_a_dwell_is_a_stop() -> None:
    law = retime(line(30.0), LIMITS, [Station(10.0)])
    assert law.speed_at(10.0) == 0.0
    assert law.duration == pytest.approx(7 + 12)


def test_two_stations_at_one_place_wait_for_both() -> None:
    law = retime(line(30.0), LIMITS, [Station(10.0, 1.0), Station(10.0, 2.0)])
    assert law.duration == pytest.approx(7 + 3 + 12)


def test_the_time_law_may_begin_under_way() -> None:
    law = retime(line(30.0), LIMITS, [Station(3.0, 9.0)], start=6.0, start_speed=2.0, start_time=50)
    assert law.times == pytest.approx([50, 61, 63])
    assert law.distances == pytest.approx([6, 28, 30])
    assert law.start_time == 50
    assert not law.stations


def test_it_may_leave_the_path_with_a_speed() -> None:
    assert retime(line(30.0), LIMITS, end_speed=2.0).duration == pytest.approx(16.0)
    assert retime(line(30.0), LIMITS, end_speed=9.0).speeds[-1] == pytest.approx(2.0)


def test_a_cap_is_one_more_limit() -> None:
    assert retime(line(30.0), LIMITS, speed_cap=1.0).speeds.max() == 1.0


def test_a_start_that_is_too_fast_brakes_and_says_how_far() -> None:
    law = retime(line(30.0), LIMITS, start_speed=4.0)
    assert law.over_limit_until == pytest.approx(6.0)
    assert law.speed_at([0.0, 6.0, 20.0]) == pytest.approx([4, 2, 2])
    assert law.accelerations.min() == pytest.approx(-1.0)
    assert retime(line(30.0), LIMITS, start_speed=2.0).over_limit_until is None


def test_a_start_too_fast_to_stop_at_a_station_is_refused() -> None:
    with pytest.raises(GeometryError, match=r"can't stop at 1 m: from 2 m/s at 0 m it needs 2 m"):
        retime(line(30.0), LIMITS, [Station(1.0, 5.0)], start_speed=2.0)
    with pytest.raises(GeometryError, match="can't stop at 30 m"):
        retime(line(30.0), LIMITS, start=29.0, start_speed=2.0)


def test_nobody_stops_at_once_where_a_path_ends() -> None:
    with pytest.raises(GeometryError, match=r"can't stop at 10 m: from 0.1 m/s at 10 m"):
        retime(line(10.0), LIMITS, start=10.0, start_speed=0.1)
    assert retime(line(10.0), LIMITS, start=10.0, start_speed=1e-5).duration == 0.0


def test_exactly_the_braking_distance_is_enough_even_far_along() -> None:
    law = retime(line(3e6), LIMITS, start=3e6 - 2.0, start_speed=2.0)
    assert law.duration == pytest.approx(2.0)
    assert law.over_limit_until is None


@pytest.mark.parametrize(
    ("words", "stations"),
    [
        ({"start": -1.0}, []),
        ({"start": 31.0}, []),
        ({"start_speed": -1.0}, []),
        ({"start_speed": float("nan")}, []),
        ({"end_speed": float("inf")}, []),
        ({"speed_cap": 0.0}, []),
        ({}, [Station(31.0, 1.0)]),
        ({}, [Station(3.0, -1.0)]),
    ],
)
def test_numbers_that_make_no_sense_are_refused(
    words: dict[str, float], stations: list[Station]
) -> None:
    with pytest.raises(GeometryError):
        retime(line(30.0), LIMITS, stations, **words)


@pytest.mark.parametrize("value", [0.0, -1.0, float("nan"), float("inf")])
def test_limits_are_finite_and_above_zero(value: float) -> None:
    with pytest.raises(GeometryError, match="max_accel"):
        Limits(max_speed=1.0, max_accel=value)


def test_the_rest_of_a_path_that_is_over_takes_no_time() -> None:
    law = retime(line(30.0), LIMITS, start=line(30.0).length)
    assert law.duration == 0.0
    assert law.distance_at(3.0) == pytest.approx(30.0)


def test_a_circle_is_driven_at_the_speed_that_its_curvature_allows() -> None:
    angles = np.linspace(0, 2 * np.pi, 65)[:-1]
    ring = CardinalSpline(10 * np.stack((np.cos(angles), np.sin(angles)), 1), closed=True)
    limits = Limits(max_speed=20.0, max_accel=1.0, max_lateral_accel=0.9)
    law = retime(ring, limits)
    top = law.speed_at(ring.length / 2)
    assert 0.9 * 3.0 < top <= 3.0 * 1.01
    assert law.speeds.max() <= np.sqrt(0.9 / 0.095)


@given(seeds)
@settings(deadline=None, max_examples=25)
def test_no_limit_is_exceeded_anywhere(seed: int) -> None:
    path = curve(seed)
    limits = Limits(max_speed=3.0, max_accel=0.8, max_lateral_accel=0.5)
    stations = [Station(0.4 * path.length, 2.0)]
    law = retime(path, limits, stations)
    u = np.linspace(*path.domain, 4001)
    speed = law.speed_at(path.distance(u))
    assert np.all(speed <= 3.0 + 1e-9)
    assert np.all(speed**2 * np.abs(path.curvature(u)) <= 0.5 * (1 + 1e-6))
    steps = np.maximum(np.diff(law.distances), 1e-300)
    rounding = 4 * np.spacing(law.distances[1:]) / steps  # near a cusp steps are nanometres
    assert np.all(np.abs(law.accelerations) <= 0.8 * (1 + 1e-6 + rounding))
    assert law.speed_at([0.0, 0.4 * path.length, path.length]).tolist() == [0, 0, 0]


@given(seeds)
@settings(deadline=None, max_examples=10)
def test_it_is_hardly_slower_than_a_very_fine_reference(seed: int) -> None:
    path = curve(seed)
    limits = Limits(max_speed=3.0, max_accel=0.8, max_lateral_accel=0.5)
    s = np.linspace(0, path.length, 100_001)
    kappa = np.abs(path.curvature(path.parameter(s)))
    square = np.minimum(9.0, 0.5 / np.maximum(kappa, 1e-9))
    square[[0, -1]] = 0.0
    ramp = 2 * 0.8 * s  # forward and backward pass: the lower envelope of ramps
    square = np.minimum.accumulate(square - ramp) + ramp
    square = np.minimum.accumulate((square + ramp)[::-1])[::-1] - ramp
    speed = np.sqrt(np.maximum(square, 0.0))
    reference = (2 * np.diff(s) / (speed[1:] + speed[:-1])).sum()
    assert reference * 0.999 <= retime(path, limits).duration <= reference * 1.03


@given(seeds)
@settings(deadline=None, max_examples=25)
def test_time_and_distance_are_inverse(seed: int) -> None:
    path = curve(seed)
    law = retime(path, LIMITS, [Station(0.3 * path.length, 1.0)])
    distances = np.linspace(0, path.length, 500)
    assert law.distance_at(law.time_at(distances)) == pytest.approx(distances, abs=1e-6)
    times = np.linspace(law.start_time, law.end_time, 5000)
    position, speed, _ = law.state_at(times)
    assert np.all(np.diff(position) >= 0)
    step = times[1] - times[0]
    assert np.gradient(position, times) == pytest.approx(speed, abs=2 * step)


def test_a_path_a_thousand_kilometres_away_is_driven_like_one_at_home() -> None:
    points = np.array([[0.0, 0], [30, 10], [60, -5], [90, 0]])
    limits = Limits(max_speed=3.0, max_accel=0.8, max_lateral_accel=0.5)
    home = retime(CardinalSpline(points), limits)
    away = retime(CardinalSpline(points + 1e6), limits)
    assert away.duration == pytest.approx(home.duration, rel=1e-4)


def test_a_corner_is_a_stop_if_there_is_a_limit_across_the_path() -> None:
    corner = CardinalSpline([[0, 0], [10, 0], [10, 10]], tension=1.0)
    assert retime(corner, LIMITS).duration == pytest.approx(20 / 2 + 2)
    careful = Limits(max_speed=2.0, max_accel=1.0, max_lateral_accel=1.0)
    law = retime(corner, careful)
    assert law.speed_at(corner.distance(1.0)) == 0.0
    assert law.duration == pytest.approx(2 * (10 / 2 + 2))
    assert law.next_rest(3.0) == pytest.approx(10.0)
    assert law.next_rest(10.5) == pytest.approx(20.0)


def test_a_path_in_space_is_driven_as_well() -> None:
    helix = CardinalSpline([[0, 0, 0], [10, 5, 2], [20, 0, 5], [30, 5, 9]])
    law = retime(helix, Limits(max_speed=2.0, max_accel=1.0, max_lateral_accel=0.3))
    assert law.distances[-1] == pytest.approx(helix.length)


def test_the_arrays_are_read_only_and_a_delay_moves_time_alone() -> None:
    law = retime(line(30.0), LIMITS)
    with pytest.raises(ValueError, match="read-only"):
        law.times[0] = 1.0
    later = law.delayed(100.0)
    assert later.times == pytest.approx(law.times + 100)
    assert later.distances is law.distances


@settings(max_examples=200, deadline=None)
@given(speed=st.floats(0.01, 3.0), brake=st.floats(0.2, 3.0), begin=st.floats(0.0, 100.0))
def test_who_has_braked_stands_without_a_hair_of_speed(
    speed: float, brake: float, begin: float
) -> None:
    """With 3e-16 m/s left a robot before a goal that was taken looked for a way on for ever."""
    law = braking(5.0, speed, max_accel=brake, start_time=begin)
    later = np.array([law.end_time, np.nextafter(law.end_time, np.inf), law.end_time + 1.0])
    assert (law.state_at(later)[1] == 0.0).all()
    assert all(float(law.state_at(float(time))[1]) == 0.0 for time in later)


def test_braking_stops_after_v_squared_over_two_a() -> None:
    law = braking(10.0, speed=3.0, max_accel=1.5, start_time=7.0)
    assert law.distances == pytest.approx([10, 13])
    assert law.times == pytest.approx([7, 9])
    assert braking(4.0, speed=0.0, max_accel=1.0, start_time=2.0).duration == 0.0


@given(st.floats(0.0, 1e3), st.floats(0.01, 10.0), st.floats(0.0, 2.0))
def test_the_stopping_speed_stops_within_its_room(room: float, accel: float, wait: float) -> None:
    speed = stopping_speed(room, accel, wait)
    assert speed >= 0
    assert speed**2 / (2 * accel) + speed * wait == pytest.approx(room, rel=1e-6, abs=1e-9)


def test_a_sensor_limits_the_speed_and_one_inside_the_body_is_refused() -> None:
    robot = RobotSpec(max_speed_mps=9.0, max_accel_mps2=0.5)
    assert Limits.of(robot).max_speed == 9.0
    sighted = robot.model_copy(update={"sensor": Sensor(range_m=5.0)})
    v = Limits.of(sighted, reaction=0.2).max_speed
    assert v**2 / (2 * 0.5) + v * 0.2 == pytest.approx(5.0 - 0.5 - 0.5)
    short = RobotSpec.model_validate({"sensor": {"range_m": 0.9}})
    v = Limits.of(short).max_speed
    assert 0 < v**2 / 2 + v * 0.1 <= 0.9 - 0.5
    blind = RobotSpec.model_validate({"sensor": {"range_m": 0.5}})
    with pytest.raises(GeometryError, match="not past the robot's own body"):
        Limits.of(blind)


@pytest.mark.parametrize("speed", [0.0, 5e-324, 2.6e-26, 1e-9])
def test_who_stops_within_the_rounding_of_its_place_stands_already(speed: float) -> None:
    law = braking(4.267, speed, max_accel=1.0, start_time=12.0)
    assert law.state_at(12.0)[1] == law.state_at(13.0)[1] == 0.0


@pytest.mark.parametrize("max_jerk", [None, 2.0])
def test_a_longer_wait_at_a_rest_delays_all_that_comes_after_it(max_jerk: float | None) -> None:
    line = Path([[[0, 0], [10, 0], [20, 0], [30, 0]]], vias=[])
    limits = Limits(max_speed=2, max_accel=1, max_jerk=max_jerk)
    law = retime(line, limits, [Station(12.0, 3.0)])
    later = law.waiting(0.0, 4.0).waiting(12.0, 5.0)
    for place, late in ((5.0, 4.0), (11.9, 4.0), (12.1, 9.0), (30.0, 9.0)):
        assert later.time_at(place) == pytest.approx(law.time_at(place) + late)
    assert len(later.times) == len(law.times) + 1  # it stays at 12 m anyway, and now at its start
    assert later.duration == pytest.approx(law.duration + 9.0)
    shorter = later.staying_at_most(4.0)
    assert shorter.duration == pytest.approx(law.duration + 5.0)
    assert shorter.staying_at_most(4.0) is shorter


@pytest.mark.parametrize(
    "name",
    ["slow", "start", "start_speed", "start_accel", "end_speed", "speed_cap", "start_time", "grid"],
)
@pytest.mark.parametrize("value", ["x", [1, 2], 1j, np.array([1.0, 2.0])])
def test_what_is_no_number_is_refused_by_name(name: str, value: object) -> None:
    with pytest.raises(GeometryError, match=name):
        retime(line(10.0), LIMITS, **{name: value})  # type: ignore[arg-type]
