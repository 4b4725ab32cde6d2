"""The time law of a part of a path is that of the part, wherever on the path it lies."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.path import Path
from viaspline.trajectory.limits import Limits, Station
from viaspline.trajectory.part import end_of_cells, retime_part
from viaspline.trajectory.retime import braking, retime

LIMITS = Limits(max_speed=2.0, max_accel=1.0, max_lateral_accel=0.5, max_jerk=2.0)


def bent() -> Path:
    points = [[0, 0], [6, 3], [12, -2], [20, 4], [26, 0], [34, 5]]
    return Path(CardinalSpline(points).spans, vias=[])


def test_a_part_that_is_the_whole_is_timed_as_the_whole() -> None:
    path = bent()
    whole, part = retime(path, LIMITS), retime_part(path, 0.0, path.length, LIMITS)
    assert part.duration == pytest.approx(whole.duration, rel=1e-4)
    assert part.distances[-1] == path.length


@settings(max_examples=6, deadline=None)
@given(start=st.floats(0.0, 20.0), length=st.floats(0.5, 12.0))
def test_a_part_begins_and_ends_where_it_is_asked_to(start: float, length: float) -> None:
    path = bent()
    end = min(start + length, path.length)
    law = retime_part(path, start, end, LIMITS, start_time=3.0)
    assert law.distances[0] == start
    assert law.distances[-1] == pytest.approx(end, abs=1e-9)
    assert law.distances[-1] <= end
    assert law.speeds[[0, -1]].tolist() == [0.0, 0.0]
    assert law.start_time == 3.0


def test_stations_stay_at_their_places_along_the_path() -> None:
    stops = [Station(10.0, 2.0, "pump"), Station(30.0, 1.0, "beyond")]
    law = retime_part(bent(), 6.0, 18.0, LIMITS, stops)
    assert [(stop.distance, stop.name) for stop in law.stations] == [(10.0, "pump")]
    assert law.speed_at(10.0) == pytest.approx(0.0, abs=1e-9)


def test_a_time_law_goes_on_as_another_where_that_takes_over() -> None:
    path = bent()
    old = retime(path, LIMITS)
    for begin in (0.4, 3.0, 7.7):
        cut = old.cut_after(begin)
        distance, speed, accel = (float(x) for x in old.state_at(cut))
        new = retime_part(
            path, distance, distance + 8.0, LIMITS, start_speed=speed, start_accel=accel,
            start_time=cut, replaces=old,
        )  # fmt: skip
        both = old.followed_by(new, since=cut - 0.3)
        before, after = np.linspace(cut - 0.3, cut, 50), np.linspace(cut, new.end_time, 50)
        for law, times in ((old, before), (new, after)):
            for found, true in zip(both.state_at(times)[:2], law.state_at(times)[:2], strict=True):
                np.testing.assert_allclose(found, true, atol=1e-9)
        assert (np.diff(both.times) >= 0.0).all()


@pytest.mark.parametrize("dwell", [None, 2.0])
def test_what_comes_before_a_rest_stays_though_the_next_law_begins_after_it(
    dwell: float | None,
) -> None:
    """The end of a braking was left out, and the robot stood at once."""
    stops = [] if dwell is None else [Station(bent().length, dwell)]
    old = retime(bent(), LIMITS, stops)
    later = braking(bent().length, 0.0, LIMITS.brake, old.end_time + 1.0)
    both = old.followed_by(later, since=old.end_time - 2.5)
    times = np.linspace(old.end_time - 2.5, old.end_time + 1.0, 60)
    for found, true in zip(both.state_at(times)[:2], old.state_at(times)[:2], strict=True):
        np.testing.assert_allclose(found, true, atol=1e-9)
    assert len(both.accelerations) == len(both.times) - 1


def test_a_part_ends_sooner_where_a_bend_has_many_cells_and_nowhere_else() -> None:
    sharp = Path(CardinalSpline([[0, 0], [6, 0], [6.02, 0.05], [0, 1]], slack=0.05).spans, vias=[])
    limits = Limits(max_speed=1.0, max_accel=0.6, max_yaw_accel=0.8, max_jerk=2.0)
    bend = float(sharp.distance(1.0))
    ends = [end_of_cells(sharp, bend - 2.0, bend + 1.0, limits, 0.5, most) for most in (60, 120)]
    assert bend - 2.0 < ends[0] < ends[1] < bend + 1.0
    law = retime_part(sharp, bend - 2.0, ends[0], limits, start_speed=0.5)
    whole = retime_part(sharp, bend - 2.0, bend + 1.0, limits, start_speed=0.5)
    assert 3 * law.times.size < whole.times.size
    assert end_of_cells(bent(), 1.0, 9.0, LIMITS, 0.5, 250) == 9.0
