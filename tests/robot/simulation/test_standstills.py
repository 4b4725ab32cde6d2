"""A robot that stands for long is stepped over, and what is said of its drive stays true."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.errors import GaveUpError
from viaspline.kernels.arrays import Floats
from viaspline.mission.model import Mission
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.robot.run import Run
from viaspline.robot.simulation import standstills
from viaspline.robot.simulation.near_times import near_times
from viaspline.robot.simulator import simulate
from viaspline.world.moving_obstacles import MovingObstacles

LONGEST_S = 1e7
"""The longest stay that a mission may ask for [s]."""

UNTIL_S = 200.0

coordinates = st.floats(-20.0, 20.0).map(lambda x: round(x, 2))


@st.composite
def moving_things(draw: st.DrawFn) -> Obstacle:
    """Something that goes straight on, or along keyframes, once or for ever."""
    error = {"growth_mps": draw(st.sampled_from([0.0, 0.0, 0.02]))}
    if draw(st.booleans()):
        velocity = [0.05 * draw(coordinates), 0.05 * draw(coordinates)]
        start = [draw(coordinates), draw(coordinates)]
        motion: dict[str, Any] = {"from": start, "velocity_mps": velocity, "error": error}
    else:
        times = np.cumsum(draw(st.lists(st.floats(0.5, 15.0), min_size=2, max_size=5)))
        frames = [[float(t), draw(coordinates), draw(coordinates)] for t in times]
        after = draw(st.sampled_from(["loop", "bounce", "stay", "vanish"]))
        motion = {"keyframes": frames, "after": after, "error": error}
    disc = {"circle": {"center": [0, 0], "radius": 0.5}}
    shape = disc if draw(st.booleans()) else {"polygon": [[0, 0], [2, 0], [0, 1]]}
    return Obstacle.model_validate({**shape, "motion": motion})


@settings(max_examples=60)
@given(thing=moving_things(), within=st.sampled_from([None, 3.0, 12.0]))
def test_whenever_something_is_near_is_among_the_times_in_which_it_may_be(
    thing: Obstacle, within: float | None
) -> None:
    moving = MovingObstacles([thing])

    def gaps(times: Floats) -> Floats:
        return moving.distance(np.zeros((len(times), 2)), times) - 0.3

    near = near_times(moving, 0, gaps, 0.0, UNTIL_S, within)
    times = np.linspace(0.0, UNTIL_S, 40_001)[:-1]
    covered = np.zeros(len(times), bool)
    for begin, end in near:
        covered |= (times >= begin - 1e-6) & (times <= end + 1e-6)
    distances, step = np.minimum(gaps(times), 1e6), float(times[1])  # far where it isn't there
    top = moving.top_speed + 0.02
    if within is None:
        stands = np.abs(np.diff(distances, append=np.inf)) == 0.0
        least = distances[covered].min(initial=np.inf) - top * step
        assert (distances[~covered] >= min(least, distances[stands].min(initial=np.inf))).all()
        begins = np.flatnonzero((distances < 0.0) & (np.roll(distances, 1) >= 0.0))
        assert covered[begins[begins > 0]].all()
    else:
        outside = np.flatnonzero((distances < within) & ~covered)
        since = np.maximum(outside - round(59.0 / step), 0)  # what has come to rest is told once
        assert np.allclose(distances[outside], distances[since], rtol=0.0, atol=1e-12)


def run_of(stay: float, robot: dict[str, Any] | None = None, **things: Any) -> Run:
    via = {"at": [5, 0], "name": "pump", "dwell_s": stay}
    route = {"start": [0, 0], "via": [via], "goal": [10, 0]}
    document = {"robot": robot or {}, "route": route, "world": things}
    return simulate(Mission.model_validate(document))


def going_by(*frames: list[float], after: str = "stay") -> dict[str, Any]:
    motion = {"keyframes": [list(frame) for frame in frames], "after": after}
    return {"circle": {"center": [0, 0], "radius": 0.3}, "motion": motion}


THERE_AND_BACK = ([0.0, 5.0, 9.0], [10.0, 5.0, 3.0], [20.0, 5.0, 9.0])
FOOTPRINT = {"footprint": [[-0.4, -0.2], [0.4, -0.2], [0.4, 0.2], [-0.4, 0.2]]}


@pytest.mark.parametrize(
    ("robot", "thing"),
    [
        ({}, going_by(*THERE_AND_BACK, after="loop")),
        ({}, going_by([100, 20, 3], [300, 5, 2], [400, 9, 2])),
        (FOOTPRINT, going_by([100, 20, 3], [300, 5, 2], [400, 9, 2])),
        ({"sensor": {"range_m": 4}}, going_by([100, 20, 3], [300, 5, 2], [320, 20, 9])),
    ],
)
def test_what_came_near_a_robot_that_stood_is_told_as_if_all_of_it_was_looked_at(
    robot: dict[str, Any], thing: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    kind = "unseen" if robot.get("sensor") else "known"
    run = run_of(600.0, robot, **{kind: [thing]})
    monkeypatch.setattr(standstills, "LONG_S", 1e9)
    whole = run_of(600.0, robot, **{kind: [thing]})
    assert len(run.times) < 0.8 * len(whole.times)
    assert run.duration == whole.duration
    assert [(e.kind, e.time) for e in run.events] == [(e.kind, e.time) for e in whole.events]
    assert run.encounters is not None
    assert whole.encounters is not None
    assert run.encounters.clearance == pytest.approx(whole.encounters.clearance, abs=1e-3)
    assert [one.obstacle for one in run.encounters.passes] == [
        one.obstacle for one in whole.encounters.passes
    ]
    assert run.certificate.clearance == whole.certificate.clearance
    middle = np.linspace(0.0, run.duration, 501)
    places = np.array([(run.place_at(t), whole.place_at(t)) for t in middle.tolist()])
    assert np.abs(places[:, 0] - places[:, 1]).max() < 1e-6


def test_the_longest_stay_takes_few_moments() -> None:
    run = run_of(LONGEST_S, known=[going_by(*THERE_AND_BACK, after="loop")])
    assert run.reached
    assert run.duration == pytest.approx(LONGEST_S + 9.0, abs=1.0)
    assert len(run.times) < 5000
    assert (np.diff(run.times) > 0.0).all()


def test_a_robot_with_a_lidar_waits_for_the_latest_departure_and_is_told_nothing_stale() -> None:
    away = {"from": [0, 0], "velocity_mps": [0.2, 0.7]}
    cart = {"circle": {"center": [5, 9], "radius": 1}, "motion": away}
    mission = Mission.model_validate(
        {
            "world": {"known": [cart], "unseen": [{"circle": {"center": [6, 1], "radius": 0.6}}]},
            "robot": {"sensor": {"lidar": {"range_m": 8, "beams": 90, "noise_m": 0.01}}},
            "route": {"start": [0, 0], "goal": [10, 0], "depart_s": LONGEST_S},
        }
    )
    run = simulate(mission)
    assert run.reached
    assert run.certificate.holds
    assert "stale" not in [event.kind for event in run.events]
    assert len(run.times) < 5000


@pytest.mark.parametrize(
    ("robot", "things", "why"),
    [
        (
            {"sensor": {"range_m": 4}, "moving": {"max_speed_mps": 1, "safety": "passive"}},
            {},
            "under passive safety",
        ),
        (
            {"sensor": {"range_m": 4}},
            {"unseen": [going_by([0, 0, 3], [10, 10, 3], after="bounce")]},
            "again and again",
        ),
    ],
)
def test_a_stay_that_can_not_be_stepped_over_is_refused_by_its_name(
    robot: dict[str, Any], things: dict[str, Any], why: str
) -> None:
    with pytest.raises(GaveUpError, match="'pump'") as caught:
        run_of(LONGEST_S, robot, **things)
    assert why in caught.value.reason
    assert "50000 s" in caught.value.remedy
