"""What moves as the map says touches no robot that drives by a passive law: tried by samples."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from charted_movers import Floats, Mover, least_gaps
from hypothesis import assume, given
from hypothesis import strategies as st

from viaspline.curve.path import Path
from viaspline.errors import GeometryError
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.trajectory.limits import Limits
from viaspline.trajectory.passive_premises import PassivePremises
from viaspline.trajectory.passive_safety import at_rest_until, passive_law, proven_until
from viaspline.trajectory.retime import braking, retime
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.moving_obstacles import MovingObstacles

KEEP, ACCEL, BEGIN, STAY = 0.3, 1.0, 2.0, 6.0
SPANS = [[(0, 0), (3, 0), (6, 1), (9, 2)]]


@cache
def path() -> Path:
    return Path(SPANS, [])


@cache
def free() -> Trajectory:
    """What it would drive if nothing could come."""
    return retime(path(), Limits(max_speed=2.0, max_accel=ACCEL), start_time=BEGIN)


places = st.tuples(st.floats(-1, 10), st.floats(-4, 5))
waits = st.floats(0.3, 4.0)


@st.composite
def movers(draw: st.DrawFn) -> list[Mover]:
    """Discs and bars that go from place to place, and then begin again, or aren't there."""
    found = []
    for _ in range(draw(st.integers(1, 3))):
        stops = draw(st.lists(st.tuples(waits, places), min_size=2, max_size=4))
        times = draw(st.floats(0.0, 6.0)) + np.cumsum([wait for wait, _ in stops])
        turn = draw(st.floats(-60, 60))
        rows = zip(times.tolist(), stops, strict=True)
        frames = [[t, *at, turn * k] for k, (t, (_, at)) in enumerate(rows)]
        after = draw(st.sampled_from(("loop", "bounce", "stay", "vanish")))
        bar = [[-0.6, -0.1], [0.6, -0.1], [0.6, 0.1], [-0.6, 0.1]]
        shape = draw(
            st.sampled_from(({"polygon": bar}, {"circle": {"center": [0, 0], "radius": 0.4}}))
        )
        found.append({**shape, "motion": {"keyframes": frames, "after": after}})
    return found


def premises_of(charted: list[Mover], reach: float = math.inf) -> PassivePremises:
    known = MovingObstacles(Obstacle.model_validate(mover) for mover in charted)
    return PassivePremises(MovingObstacles(), BEGIN, 1.0, (0.0, 0.0), reach, charted=known)


def least_gap(charted: list[Mover], law: Trajectory) -> float:
    """The least distance to all of it while the robot moves by a law [m]."""
    times = np.arange(law.start_time, law.end_time, 0.01)
    distances, speeds, _ = law.state_at(times)
    found = least_gaps(charted, times, np.asarray(path().at_distance(distances)), KEEP)
    return float(found[speeds > 1e-6].min(initial=math.inf))


def at_rest(charted: list[Mover], distance: float, times: Floats) -> Floats:
    """The distance to all of it of a robot that stands at a distance along the path [m], (n,)."""
    place = np.asarray(path().at_distance(distance))
    return least_gaps(charted, times, np.tile(place, (len(times), 1)), KEEP)


@given(movers(), st.floats(1.0, 8.0))
def test_nothing_on_the_map_touches_a_robot_that_moves(charted: list[Mover], reach: float) -> None:
    premises = premises_of(charted, reach)
    law, proven = passive_law(path(), free(), premises, KEEP, (ACCEL, ACCEL), BEGIN)
    assert proven  # it stands when it begins, and nothing touches a robot that moves then
    assert proven_until(path(), law, premises, KEEP) == math.inf
    assert least_gap(charted, law) > 0.0
    for k in range(0, len(law.times) - 1, 5):
        stop = braking(float(law.distances[k]), float(law.speeds[k]), ACCEL, float(law.times[k]))
        assert least_gap(charted, stop) > 0.0


@given(movers(), st.floats(0.5, 2.0))
def test_where_it_has_to_stop_nothing_on_the_map_comes_for_as_long_as_is_asked(
    charted: list[Mover], lasting: float
) -> None:
    premises, limits = premises_of(charted), (ACCEL, ACCEL)
    law, proven = passive_law(path(), free(), premises, KEEP, limits, BEGIN, lasting, STAY)
    assume(proven)
    for s, v, t in zip(
        law.distances.tolist(), law.speeds.tolist(), law.times.tolist(), strict=True
    ):
        stands = np.arange(t + v / ACCEL, t + v / ACCEL + STAY, 0.05)
        assert at_rest(charted, s + v * v / (2.0 * ACCEL), stands).min() > 0.0


@given(movers(), st.floats(0.0, 9.0))
def test_it_is_told_when_the_first_of_it_comes_to_a_robot_that_stands(
    charted: list[Mover], distance: float
) -> None:
    told = at_rest_until(path(), distance, BEGIN, STAY, premises_of(charted), KEEP)
    times = np.arange(BEGIN, BEGIN + STAY, 0.01)
    found = at_rest(charted, distance, times)
    near = np.flatnonzero(found <= 0.0)
    assert not near.size or told <= times[near[0]]
    if told < math.inf:
        fastest = max(gap_rate(mover) for mover in charted)
        assert found[np.abs(times - told) <= 0.02].min() <= 0.005 + 0.02 * fastest


def gap_rate(mover: Mover) -> float:
    """How fast a point of it goes at most [m/s]."""
    rows = np.array(mover["motion"]["keyframes"])
    lasts = np.diff(rows[:, 0])
    straight = np.hypot(*np.diff(rows[:, 1:3], axis=0).T) / lasts
    return float((straight + 0.7 * np.radians(np.abs(np.diff(rows[:, 3]))) / lasts).max())


def test_what_appears_on_the_map_in_its_way_is_known_to_appear() -> None:
    """A motion that begins doesn't come nearer at any speed: it is there at once."""
    motion = {"keyframes": [[4.0, 3.0, 0.0], [5.0, 3.0, 0.0], [6.0, 3.0, 3.0]], "after": "vanish"}
    ghost = {"circle": {"center": [0, 0], "radius": 0.4}, "motion": motion}
    law, _ = passive_law(path(), free(), premises_of([ghost]), KEEP, (ACCEL, ACCEL), BEGIN)
    assert float(free().distance_at(4.0)) == pytest.approx(
        2.0, abs=0.1
    )  # on which it would drive on
    assert float(law.distance_at(4.0)) < 2.3 - 1e-3
    assert least_gap([ghost], law) > 0.0
    until = at_rest_until(path(), 3.0, BEGIN, STAY, premises_of([ghost]), KEEP)
    assert until == pytest.approx(4.0, abs=1e-5)


def test_standing_from_before_the_look_is_refused() -> None:
    with pytest.raises(GeometryError, match="give the look before"):
        at_rest_until(path(), 1.0, BEGIN - 1.0, STAY, premises_of([]), KEEP)
