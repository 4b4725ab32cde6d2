"""Points of the route that something stays on for good: refused by a proof, and only then."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import viaspline as vs


def mission(keyframes: list[list[float]], after: str, via: dict[str, Any]) -> vs.Mission:
    van = {
        "name": "van",
        "circle": {"center": [0, 0], "radius": 0.5},
        "motion": {"keyframes": keyframes, "after": after},
    }
    return vs.Mission.model_validate(
        {
            "world": {"known": [van]},
            "robot": {"radius_m": 0.3, "clearance_m": 0.2},
            "route": {"start": [0, 0], "via": [via], "goal": [20, 0]},
        }
    )


def refused(asked: vs.Mission) -> vs.NoPathError:
    with pytest.raises(vs.NoPathError) as caught:
        vs.plan(asked)
    return caught.value


def test_a_point_on_which_something_parks_for_good_is_refused_with_since_when() -> None:
    """It gave up with "depart at another time", which can't help."""
    error = refused(mission([[0, 10, 9], [2, 10, 0.4]], "stay", {"at": [10, 0], "name": "pump"}))
    assert str(error).startswith("'pump' can't be served: 'van' is nearer than 0.5 m to it")
    assert "from 2.0 s on, for good" in str(error)
    assert "the robot can't be there before" in str(error)
    assert error.remedy == "move 'pump', leave it out, or take 'van' off it"
    assert (error.where, error.obstacles) == ((10.0, 0.0), ("van",))


def test_a_point_round_which_something_turns_for_ever_is_refused() -> None:
    around = [[0, 10, 0.3], [3, 10.3, 0], [6, 10, -0.3]]
    assert "all the time, on its round" in str(refused(mission(around, "bounce", {"at": [10, 0]})))


def test_a_stay_that_is_too_long_is_refused_with_one_that_is_not() -> None:
    frames = [[0, 10, 9], [20, 10, 9], [24, 10, 0]]
    station = {"at": [10, 0], "name": "pump", "dwell_s": 60}
    error = refused(mission(frames, "stay", station))
    shorter = float(error.remedy.split("(dwell_s of 'pump': ")[1].rstrip(")"))
    assert 8.0 < shorter < 20.0
    station["dwell_s"] = shorter - 2.0  # the proof has a robot that needs no room
    assert vs.plan(mission(frames, "stay", station)).moving_certificate is not None


def outcome_of(asked: vs.Mission) -> str:
    try:
        vs.plan(asked)
    except vs.NoPathError:
        return "refused"
    except vs.GaveUpError:
        return "gave up"
    return "planned"


@settings(max_examples=12, deadline=None)
@example(9.0, 0.0)
@example(2.0, 1.0)
@given(st.floats(1.0, 16.0), st.floats(0.0, 4.0))
def test_one_that_is_refused_is_one_that_no_drive_could_be_in_time_for(
    parks_at: float, stays: float
) -> None:
    """With all else alike, a robot that keeps nothing and never brakes is too late as well."""
    frames = [[0, 10, 30], [parks_at, 10, 0]]
    station = {"at": [10, 0], "dwell_s": stays}
    soonest = max(10 / 2.0, (2 if stays else 2**0.5) * 10**0.5)  # 2 m/s and 1 m/s² at most
    comes = parks_at * (1 - 1.0 / 30)  # when it is 1 m from the point
    asked, late = mission(frames, "stay", station), soonest + stays - comes
    outcome = outcome_of(asked)
    if outcome == "refused":
        assert late > -1e-6
    elif outcome == "planned":
        assert late <= 1e-6
    else:
        assert late > -4.0


def round_trip(parked_at: list[float], since: float, **route: Any) -> vs.Mission:
    """Round a square of 10 m and back to the start, at 1 m/s."""
    motion = {"keyframes": [[0, 40, 40], [since, *parked_at]], "after": "stay"}
    van = {"name": "van", "circle": {"center": [0, 0], "radius": 0.5}, "motion": motion}
    robot = {"radius_m": 0.3, "clearance_m": 0.2, "max_speed_mps": 1.0, "max_accel_mps2": 1.0}
    via = [[10, 0], [10, 10], [0, 10]]
    data = {"start": [0, 0], "via": via, "closed": True, **route}
    return vs.Mission.model_validate({"world": {"known": [van]}, "robot": robot, "route": data})


def test_a_round_on_whose_end_something_parks_is_refused() -> None:
    """It gave up after seconds with "depart at another time"."""
    error = refused(round_trip([0.3, 0.3], 35.0))
    assert str(error).startswith("the end of the round can't be held for 0 s: 'van' is from 35")
    assert "the robot can't be there before 40.0 s" in str(error)
    assert error.remedy == "move the start, or take the obstacle off it"
    assert vs.plan(round_trip([0.3, 0.3], 60.0)).moving_certificate is not None
    with pytest.raises(vs.NoPathError):
        vs.plan(round_trip([0.3, 0.3], 60.0, laps=2))


def test_a_point_that_is_taken_before_the_points_before_it_are_served_is_refused() -> None:
    """Straight from the start it would be reached in time."""
    error = refused(round_trip([0.3, 10.3], 15.0))
    assert str(error).startswith("'via 3' can't be served: 'van'")
    assert vs.plan(round_trip([0.3, 10.3], 60.0)).moving_certificate is not None
