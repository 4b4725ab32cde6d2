"""Limits that couple speed and acceleration: waits at rests alone, found by ``law_among``."""

import numpy as np
import pytest

from viaspline.curve.cardinal import CardinalSpline
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.planning.problem.method import Found, GaveUp
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.retime import retime
from viaspline.trajectory.yielding.law_among import law_among
from viaspline.world.moving_obstacles import MovingObstacles

LIMITS = (
    Limits(max_speed=2, max_accel=1, max_jerk=1.0),
    Limits(max_speed=2, max_accel=1, axis_accel=(0.8, 0.5)),
)


@pytest.fixture(scope="module")
def path() -> CardinalSpline:
    return CardinalSpline([(0, 0), (8, 2), (16, -1), (24, 1)])


def disc(at: tuple[float, float], speed: float, late: float) -> Obstacle:
    """A disc that goes up through a place at a time."""
    motion = {"from": (at[0], at[1] - speed * late), "velocity_mps": (0, speed)}
    return Obstacle(circle={"center": (0, 0), "radius": 0.8}, motion=motion)


@pytest.mark.parametrize("limits", LIMITS)
@pytest.mark.parametrize("late", [3.0, 5.0, 8.0, 14.0])
def test_the_law_between_rests_is_the_static_one(
    path: CardinalSpline, limits: Limits, late: float
) -> None:
    stations = [Station(10.0, dwell=2.0)]
    moving = MovingObstacles([disc((5, 1.5), 1.0, late), disc((18, -1), 0.7, late + 4.0)])
    static = retime(path, limits, stations)
    outcome = law_among(path, limits, stations, moving=moving, required=0.4)
    assert isinstance(outcome, Found)
    law = outcome.value
    times = np.arange(0.0, law.end_time, 0.0005)
    places = path.at_distance(np.minimum(law.distance_at(times), path.length))
    assert moving.distance(places, times).min() >= 0.4
    s = np.linspace(0.0, path.length, 500)
    assert np.allclose(law.speed_at(s), static.speed_at(s))
    delays = law.time_at(s) - static.time_at(s)
    assert np.unique(np.round(delays, 6)).size <= 3


def test_what_no_wait_lets_pass_is_given_up(path: CardinalSpline) -> None:
    motion = {"from": tuple(path.at_distance(12.0)), "velocity_mps": (0, 0)}
    parked = Obstacle(circle={"center": (0, 0), "radius": 0.8}, motion=motion)
    outcome = law_among(path, LIMITS[0], moving=MovingObstacles([parked]), required=0.4)
    assert isinstance(outcome, GaveUp)
    assert outcome.would_help
