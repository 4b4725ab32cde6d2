"""A law that is proven is touched by nothing that the premises allow, tried by brute force."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.path import Path
from viaspline.errors import GeometryError
from viaspline.kernels.arrays import Floats
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.passive_premises import SPACING_M, ChordTable, PassivePremises
from viaspline.trajectory.passive_safety import (
    passive_law,
    proven_until,
    stoppable_speeds,
    touched_from,
)
from viaspline.trajectory.retime import braking, retime
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles

KEEP = 0.3
BRAKE = 1.0
TOLERANCE = 0.03  # what chords, least gaps and samples of the oracle may make of a gap [m]

places = st.tuples(st.floats(-9, 9), st.floats(-9, 9))
discs = st.tuples(places, st.floats(-1.5, 1.5), st.floats(-1.5, 1.5), st.floats(0.1, 0.5),
                  st.floats(0, 0.2), st.floats(0, 1.5))  # fmt: skip
mouths = st.tuples(places, places)


@st.composite
def scenes(draw: st.DrawFn) -> tuple[Path, PassivePremises]:
    """A bent path from the origin, and what may come."""
    turn = draw(st.floats(-2.0, 2.0))
    path = Path([[(0, 0), (3, 0), (6, turn), (9, 2 * turn)]], [])
    rows = draw(st.lists(discs, max_size=4))
    lines = np.array([(*a, *b) for a, b in draw(st.lists(mouths, max_size=3))]).reshape(-1, 4)
    top = draw(st.floats(0.2, 2.5))
    reach = draw(st.one_of(st.just(math.inf), st.floats(1.0, 12.0)))
    tubes = MovingObstacles((disc(*row) for row in rows), since=2.0)
    return path, PassivePremises(tubes, 2.0, top, (0.1, -0.2), reach, lines)


def disc(at: tuple[float, float], vx: float, vy: float, radius: float, error: float, growth: float
         ) -> Obstacle:  # fmt: skip
    """A disc that is at a place at 2 s."""
    motion = {
        "from": (at[0] - 2 * vx, at[1] - 2 * vy),
        "velocity_mps": (vx, vy),
        "error": {"position_m": error, "growth_mps": growth},
    }
    circle = {"center": (0, 0), "radius": radius}
    return Obstacle.model_validate({"circle": circle, "motion": motion})


def threats_of(premises: PassivePremises, t: float, place: Floats) -> float:
    """The least distance to what may be there at an instant, by the premises in plain words."""
    late = t - premises.seen_at
    walked = premises.top_speed * late
    gaps = [premises.reach - math.dist(place, premises.eye) - walked]
    for x0, y0, x1, y1 in premises.mouths.tolist():
        along = np.linspace(0.0, 1.0, 200)[:, None]
        line = (1 - along) * (x0, y0) + along * (x1, y1)
        gaps.append(float(np.hypot(*(line - place).T).min()) - walked)
    for obstacle in premises.tubes.obstacles:
        assert obstacle.motion is not None
        assert obstacle.circle is not None
        then = np.array(obstacle.motion.from_) + np.array(obstacle.motion.velocity_mps) * t
        was = np.array(obstacle.motion.from_) + np.array(obstacle.motion.velocity_mps) * 2.0
        error, radius = obstacle.motion.error, obstacle.circle.radius
        in_tube = math.dist(then, place) - radius - error.position_m - error.growth_mps * late
        gaps.append(max(in_tube, math.dist(was, place) - radius - error.position_m - walked))
    return min(gaps)


def least_gap(path: Path, law: Trajectory, premises: PassivePremises) -> float:
    """The least distance while the robot moves, by samples."""
    times = np.linspace(law.start_time, law.end_time, 400)
    distances, speeds, _ = law.state_at(times)
    gaps = [
        threats_of(premises, t, place)
        for t, place, v in zip(times, np.asarray(path.at_distance(distances)), speeds, strict=True)
        if v > 1e-6
    ]
    return min(gaps, default=math.inf)


@given(scenes(), st.floats(0.0, 2.5), st.floats(0.0, 1.0), st.floats(0.0, 3.0))
@settings(deadline=None, max_examples=150)
def test_braking_is_proven_where_nothing_can_be_in_the_way(
    scene: tuple[Path, PassivePremises], speed: float, late: float, start: float
) -> None:
    """And only there, but for a few centimetres."""
    path, premises = scene
    law = braking(start, speed, BRAKE, 2.0 + late)
    gap = least_gap(path, law, premises)
    until = proven_until(path, law, premises, KEEP)
    if math.isinf(until):
        assert gap > KEEP - 1e-9
    elif speed > 1e-3:
        assert gap < KEEP + TOLERANCE
        assert law.start_time <= until <= law.end_time


@pytest.mark.slow
@given(scenes())
@settings(deadline=None, max_examples=30)
def test_a_passive_law_and_braking_from_anywhere_on_it_are_touched_by_nothing(
    scene: tuple[Path, PassivePremises],
) -> None:
    path, premises = scene
    free = retime(path, Limits(max_speed=2.0, max_accel=1.0), start_time=2.0)
    law, proven = passive_law(path, free, premises, KEEP, (1.0, BRAKE), 2.0)
    assert proven  # a robot that stands is at rest
    squares = np.interp(law.distances, free.distances, free.speeds**2)
    assert (law.speeds**2 <= squares + 1e-9).all()
    assert (np.abs(law.accelerations) <= 1.0 + 1e-9).all()
    assert law.speeds[-1] == 0.0
    assert least_gap(path, law, premises) > KEEP - 1e-9
    assert math.isinf(proven_until(path, law, premises, KEEP))
    step = max(len(law.distances) // 8, 1)
    for s, v, t in itertools.islice(
        zip(law.distances, law.speeds, law.times, strict=True), 0, None, step
    ):
        brake = braking(float(s), float(v), BRAKE, float(t))
        assert least_gap(path, brake, premises) > KEEP - 1e-9


@given(scenes(), st.floats(0.1, 1.0))
@settings(deadline=None, max_examples=30)
def test_one_that_settles_after_its_law_is_not_touched_meanwhile(
    scene: tuple[Path, PassivePremises], settle: float
) -> None:
    path, premises = scene
    free = retime(path, Limits(max_speed=2.0, max_accel=1.0), start_time=2.0)
    law, proven = passive_law(path, free, premises, KEEP, (1.0, BRAKE), 2.0, settle=settle)
    assert proven
    end, rest = law.end_time, np.asarray(path.at_distance(law.distances[-1]))
    if end == law.start_time:
        return
    gaps = [threats_of(premises, t, rest) for t in np.linspace(end, end + settle, 50)]
    assert min(gaps) > KEEP - 1e-9
    assert math.isinf(touched_from(path, law.distances[-1], end, settle, premises, KEEP))


@given(scenes(), st.floats(0.0, 6.0), st.floats(0.01, 4.0))
@settings(deadline=None, max_examples=50)
def test_one_that_stands_is_told_from_when_on_it_may_be_touched(
    scene: tuple[Path, PassivePremises], at: float, stay: float
) -> None:
    path, premises = scene
    place = np.asarray(path.at_distance(at))
    until = touched_from(path, at, 2.0, stay, premises, KEEP)
    times = np.linspace(2.0, min(until, 2.0 + stay), 30, endpoint=False)
    for t in times if until > 2.0 else ():
        assert threats_of(premises, t, place) > KEEP - 1e-9
    if until < math.inf:
        assert threats_of(premises, until, place) < KEEP + TOLERANCE


@given(scenes(), st.floats(0.0, 6.0), st.floats(0.0, 2.0))
@settings(deadline=None, max_examples=50)
def test_from_stoppable_speeds_the_robot_stops_in_time(
    scene: tuple[Path, PassivePremises], at: float, late: float
) -> None:
    path, premises = scene
    [speed] = stoppable_speeds(path, [at], [2.0 + late], [2.0], premises, KEEP, BRAKE)
    law = braking(at, float(speed), BRAKE, 2.0 + late)
    assert 0.0 <= speed <= 2.0
    assert least_gap(path, law, premises) > KEEP - 1e-9
    if speed < 2.0:
        faster = braking(at, float(speed) + 1e-3, BRAKE, 2.0 + late)
        assert least_gap(path, faster, premises) < KEEP + TOLERANCE


def test_where_nothing_can_come_a_passive_law_is_the_fastest() -> None:
    path = Path([[(0, 0), (3, 0), (6, 1), (9, 2)]], [])
    free = retime(path, Limits(max_speed=2.0, max_accel=1.0))
    empty = PassivePremises(MovingObstacles(), 0.0, 2.0, (0.0, 0.0))
    law, proven = passive_law(path, free, empty, KEEP, (1.0, 1.0), 0.0)
    assert proven
    assert law.duration == pytest.approx(free.duration, rel=1e-6)


def test_a_robot_that_is_too_fast_to_stop_brakes_and_is_told_so() -> None:
    path = Path([[(0, 0), (3, 0), (6, 0), (9, 0)]], [])
    free = retime(path, Limits(max_speed=2.0, max_accel=1.0), start_speed=2.0)
    near = PassivePremises(MovingObstacles(), 0.0, 2.0, (0.0, 0.0), reach=3.0)
    law, proven = passive_law(path, free, near, KEEP, (1.0, 1.0), 0.0)
    assert not proven
    assert law.distances[-1] == pytest.approx(2.0)
    assert law.duration == pytest.approx(2.0)


def test_a_robot_that_stands_where_it_may_be_run_over_stays() -> None:
    path = Path([[(0, 0), (3, 0), (6, 0), (9, 0)]], [])
    free = retime(path, Limits(max_speed=2.0, max_accel=1.0))
    near = PassivePremises(MovingObstacles(), 0.0, 2.0, (0.0, 0.0), reach=0.2)
    law, proven = passive_law(path, free, near, KEEP, (1.0, 1.0), 0.0)
    assert proven
    assert law.end_time == law.start_time == 0.0
    assert float(law.state_at(3.0)[0]) == 0.0


def test_a_law_from_before_the_look_and_one_with_a_limit_of_the_jerk_are_refused() -> None:
    path = Path([[(0, 0), (3, 0), (6, 0), (9, 0)]], [])
    look = PassivePremises(MovingObstacles(), 5.0, 2.0, (0.0, 0.0))
    with pytest.raises(GeometryError, match="give the look before"):
        proven_until(path, braking(0.0, 1.0, 1.0, 4.0), look, KEEP)
    smooth = retime(path, Limits(max_speed=2.0, max_accel=1.0, max_jerk=1.0), start_time=5.0)
    with pytest.raises(GeometryError, match="jerk"):
        proven_until(path, smooth, look, KEEP)
    with pytest.raises(GeometryError, match="jerk"):
        passive_law(path, smooth, look, KEEP, (1.0, 1.0), 5.0)


@given(st.floats(-3, 3), st.floats(0.0, 1.0), st.floats(0.0, 1.0))
@settings(deadline=None)
def test_chords_are_no_farther_from_the_path_than_they_say(
    turn: float, first: float, last: float
) -> None:
    path = Path([[(0, 0), (1, 0), (1, turn), (2, turn)]], [])
    start, end = sorted((first * path.length, last * path.length))
    part = ChordTable.of(path, start, end)
    along = np.linspace(start, end, 300)
    behind = (along - part.origin) / SPACING_M
    chords = np.column_stack(
        [np.interp(behind, np.arange(len(part.places)), part.places[:, k]) for k in range(2)]
    )
    off = np.hypot(*(np.asarray(path.at_distance(along)) - chords).T)
    assert off.max() <= part.sag + 1e-6
    assert part.sag < 0.01
