"""A closed path driven lap after lap: the same places, period after period."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.errors import GeometryError
from viaspline.fleet.patrols.driven_laps import driven_laps, on_nodes, seams_of
from viaspline.fleet.patrols.repeated_laws import repeated_law, set_out
from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan

ROUTE = {"start": [0, 0], "via": [{"at": [9, 0], "dwell_s": 3}, [9, 9]], "closed": True}
Lap = Callable[[], Plan]


@cache
def plain() -> Plan:
    return plan(Mission.model_validate({"route": ROUTE}))


@cache
def smooth() -> Plan:
    return plan(Mission.model_validate({"route": ROUTE, "robot": {"max_jerk_mps3": 1.0}}))


@pytest.mark.parametrize("made", [plain, smooth], ids=["plain", "with a limit of the jerk"])
def test_every_lap_is_the_first_one_again_from_rest_to_rest(made: Lap) -> None:
    lap = made()
    three = driven_laps(lap, 3)
    law, once = three.trajectory, lap.trajectory
    assert law.duration == pytest.approx(3.0 * once.duration, rel=1e-6)
    times = np.linspace(0.0, once.duration, 500)
    for k in range(3):
        begun = times + k * once.duration
        there = three.path.at_distance(law.distance_at(begun))
        first = lap.path.at_distance(once.distance_at(times))
        assert np.abs(there - first).max() < 1e-4
    assert law.speed_at(seams_of(three.path, 3)).max() == 0.0
    assert [via.index for via in three.path.vias if via.index] == list(range(1, 10))


@settings(max_examples=30, deadline=None)
@given(st.floats(0.0, 50.0), st.integers(1, 4), st.sampled_from([plain, smooth]))
def test_a_law_comes_again_every_period(waits: float, laps: int, made: Lap) -> None:
    lap = made()
    law = lap.trajectory.delayed(7.0)
    period = law.duration + waits
    path = driven_laps(lap, laps).path
    again = repeated_law(law, seams_of(path, laps), period)
    assert (np.diff(again.times) >= 0.0).all()
    assert (np.diff(again.distances) >= 0.0).all()
    assert len(again.accelerations) == len(again.times) - 1
    assert again.end_time == pytest.approx(law.end_time + (laps - 1) * period)
    times = np.linspace(7.0, 7.0 + laps * period, 300)
    phases = 7.0 + np.minimum((times - 7.0) % period, law.duration)
    folded = lap.path.at_distance(law.distance_at(phases))
    there = path.at_distance(again.distance_at(times))
    assert np.abs(there - folded).max() < 1e-5


def test_a_lap_that_takes_longer_than_the_period_is_refused() -> None:
    lap = plain()
    with pytest.raises(GeometryError, match="longer"):
        repeated_law(lap.trajectory, np.array([0.0, lap.path.length]), 1.0)


def test_what_a_law_waits_at_its_start_is_left_out() -> None:
    law = plain().trajectory.waiting(0.0, 12.0)
    begun = set_out(law)
    assert begun.start_time == 12.0
    assert begun.duration == pytest.approx(plain().trajectory.duration)
    assert set_out(begun).times.tolist() == begun.times.tolist()


def test_points_of_a_law_are_put_on_nodes_that_they_are_as_good_as_on() -> None:
    law = plain().trajectory
    nodes = np.sort(np.unique(law.distances) + 1e-9)
    put = on_nodes(law, nodes)
    assert np.isin(put.distances, nodes).all()
    far = on_nodes(law, np.array([0.0, 1.0, 500.0]))
    assert np.abs(far.distances - law.distances).max() < 1e-6
