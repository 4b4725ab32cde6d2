"""Whatever comes no faster than was said: nothing touches a flying robot before it is at rest."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import event, given, settings
from hypothesis import strategies as st
from unseen_flights import gaps_and_speeds, mission, moves, wanderer

from viaspline.mission.space.flying_body import FlyingBody
from viaspline.space.online.fly import fly
from viaspline.space.online.passive_flight import FlightThreats
from viaspline.space.plan_spatial import plan_spatial

TOP = 3.0
PASSIVE = {"max_speed_mps": TOP, "safety": "passive"}


@pytest.mark.slow
@settings(max_examples=4)
@given(seed=st.integers(0, 100_000))
def test_nothing_touches_a_robot_under_way(seed: int) -> None:
    rng = np.random.default_rng(seed)
    moving = [wanderer(rng, f"m{k}", TOP, far=30.0) for k in range(int(rng.integers(1, 4)))]
    moving = [one for one in moving if gaps_at_start(one) > 3.0]
    asked = mission(moving, things=PASSIVE, noise=float(rng.choice((0.0, 0.3))), goal=[30, 0, 10])
    run = fly(plan_spatial(asked), seed=seed)
    event("reached" if run.reached else "not reached")
    for one in moving:
        gaps, speeds = gaps_and_speeds(run, one)
        assert gaps[speeds > 0.02].min() > -4e-3  # places are interpolated there
    assert run.encounters is not None
    assert all(one.robot_speed == 0.0 for one in run.encounters.contacts)


def gaps_at_start(one: dict) -> float:  # type: ignore[type-arg]
    """How far a ball is from the start at first."""
    _, x, y, _, z = one["motion"]["keyframes"][0]
    return float(np.linalg.norm((x, y, z - 10))) - one["ball"]["radius"] - 0.5


def test_who_sees_little_flies_slowly_even_where_nothing_moves() -> None:
    short = {"things": PASSIVE, "goal": [40, 0, 10]}
    far = fly(plan_spatial(mission([], reach=60, **short)))
    near = fly(plan_spatial(mission([], reach=4, **short)))
    assert far.reached
    assert near.reached
    assert far.speeds.max() == pytest.approx(5.0)
    # what it doesn't see may be 4 - 0.5 m away: 0.3 s of reaction and a stop by 2 m/s² together
    # with what comes at 3 m/s allow v with (v + 3) 0.3 + v²/4 + 3 v/2 <= 3.5
    assert 0.6 < near.speeds.max() <= 1.4


def test_a_frozen_robot_says_so_after_a_minute() -> None:
    run = fly(plan_spatial(mission([], things={"max_speed_mps": 20, "safety": "passive"}, reach=1)))
    assert not run.reached
    assert "no step of it was proven safe" in run.reason
    assert run.duration == pytest.approx(60, abs=1)


def test_what_runs_into_a_hovering_robot_is_told_as_such() -> None:
    chases = moves("dog", 0.5, [[0, 30, 0, 10], [12, 0, 0, 10], [14, 0, 0, 10], [34, 60, 40, 10]])
    run = fly(plan_spatial(mission([chases], things=PASSIVE)))
    assert run.encounters is not None
    assert {one.robot_speed for one in run.encounters.contacts} <= {0.0}


@given(seed=st.integers(0, 10_000))
def test_until_its_deadline_nothing_that_was_seen_or_not_reaches_a_stretch(seed: int) -> None:
    rng = np.random.default_rng(seed)
    eye, reach = rng.uniform(-5, 5, 3), float(rng.uniform(4, 20))
    body = FlyingBody(float(rng.uniform(0, 1)), float(rng.uniform(0, 1)), float(rng.uniform(0, 1)))
    its = FlyingBody(float(rng.uniform(0, 1)), float(rng.uniform(0, 2)), float(rng.uniform(0, 1)))
    way = rng.normal(size=3)
    step = float(rng.uniform(0.01, 0.3))
    places = eye + np.arange(6)[:, None] * step * way / np.linalg.norm(way)
    at = places[2] + rng.uniform(-8, 8, 3)
    threats = FlightThreats([its], at[None], (), body, eye, reach, 2.0, TOP)
    late = threats.deadlines(places, step) - 2.0
    for k, deadline in enumerate(late.tolist()):
        between = places[k] + np.linspace(0, 1, 7)[:, None] * (places[k + 1] - places[k])
        for place in between:
            toward = place - at
            gone = at + min(TOP * max(deadline, 0.0) / np.linalg.norm(toward), 1.0) * toward
            assert deadline <= 0 or body.gaps(its, (gone - place)[None])[0] > -1e-9
            unseen = reach - np.linalg.norm(place - eye) - body.outermost
            assert deadline <= 0 or unseen - TOP * deadline > -1e-9
