"""Stations: the navigator holds a robot there for its time, by what it reports."""

from __future__ import annotations

import numpy as np
import pytest

import viaspline as vs

SPANS = {"separation_m": 1.0, "robots": {"cart": {"radius_m": 0.5, "max_speed_mps": 2.0}}}
ROUTE = {"start": [0, 0], "via": [{"at": [20, 0], "dwell_s": 8}], "goal": [40, 0]}


@pytest.fixture(scope="module")
def plan() -> vs.FleetPlan:
    other = {"start": [30, -20], "goal": [30, 20]}
    robots = [{"name": "a", "route": ROUTE}, {"name": "b", "route": other}]
    return vs.plan_fleet(vs.Fleet.model_validate({**SPANS, "fleet": robots}))


def test_a_robot_is_let_to_its_station_and_on_when_it_has_stood_there(plan: vs.FleetPlan) -> None:
    nav = vs.FleetNavigator(plan)
    commands, nav = nav.step([], 0.0)
    assert commands["a"].granted == pytest.approx(20.0)
    assert commands["a"].waits_for is None
    assert commands["a"].stands_until is None
    place = commands["a"].granted
    for time, speed, until in ((11.0, 1.0, None), (12.0, 0.0, 20.0), (19.9, 0.0, 20.0)):
        report = vs.ProgressReport("a", time, place, speed)
        commands, nav = nav.step([report], time)
        assert commands["a"].granted == pytest.approx(20.0)
        assert commands["a"].stands_until == until
        assert speed > 0.0 or commands["a"].speed == 0.0
    commands, nav = nav.step([], 20.0)  # nothing need be heard of it meanwhile
    assert commands["a"].granted > 20.0
    assert commands["a"].stands_until is None


@pytest.mark.parametrize("short", [0.0, 0.03, 0.05])
def test_who_stops_a_little_short_of_its_station_stands_there(
    plan: vs.FleetPlan, short: float
) -> None:
    _, nav = vs.FleetNavigator(plan).step([], 0.0)
    commands, nav = nav.step([vs.ProgressReport("a", 12.0, 20.0 - short)], 12.0)
    assert commands["a"].stands_until == 20.0
    far, _ = nav.step([vs.ProgressReport("a", 12.0, 20.0 - short)], 20.0)
    assert far["a"].granted > 20.0


def test_who_stops_farther_back_does_not(plan: vs.FleetPlan) -> None:
    _, nav = vs.FleetNavigator(plan).step([], 0.0)
    commands, nav = nav.step([vs.ProgressReport("a", 12.0, 19.0)], 12.0)
    assert commands["a"].stands_until is None
    commands, _ = nav.step([], 100.0)
    assert commands["a"].granted == pytest.approx(20.0)


def test_the_time_at_a_station_counts_from_the_departure_where_it_is_the_start() -> None:
    route = {"start": {"at": [0, 0], "dwell_s": 5}, "goal": [40, 0], "depart_s": 10}
    plan = vs.plan_fleet(
        vs.Fleet.model_validate({**SPANS, "fleet": [{"name": "a", "route": route}]})
    )
    nav = vs.FleetNavigator(plan)
    let = []
    for time in np.arange(0.0, 20.0, 1.0).tolist():
        commands, nav = nav.step([vs.ProgressReport("a", time, 0.0)], time)
        let.append(commands["a"].granted > 0.0)
    assert let.index(True) in (15, 16)


def test_a_delay_at_a_station_is_expected(plan: vs.FleetPlan) -> None:
    _, nav = vs.FleetNavigator(plan).step([], 0.0)
    alone = plan.rides.alone[0]
    assert nav.expected()["a"] == pytest.approx(alone, abs=1.0)
    _, nav = nav.step([vs.ProgressReport("a", 50.0, 20.0)], 50.0)
    assert nav.expected()["a"] >= 50.0 + 20.0 / 2.0
