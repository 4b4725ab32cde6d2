"""Patrols that never end: a common period, the others past them, and a proof for ever."""

from __future__ import annotations

import tempfile
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from periodic_places import nearest

from viaspline.fleet.crossing_paths import crossing_paths
from viaspline.fleet.execution.delays import Delays
from viaspline.fleet.execution.simulate_fleet import simulate_fleet
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.patrols.unrolled_patrols import unrolled
from viaspline.fleet.plan_fleet import plan_by_priority, plan_fleet
from viaspline.fleet.saved.load_fleet_plan import load_fleet_plan
from viaspline.fleet.timelines import timelines_of
from viaspline.mission.fleet.fleet import Fleet
from viaspline.planner import plan as plan_alone

SQUARE = {"start": [0, 0], "via": [[20, 0], [20, 20], [0, 20]], "closed": True}


def fleet_of(*robots: dict[str, Any], separation: float = 0.5) -> Fleet:
    named = [{"name": f"r{k}", **robot} for k, robot in enumerate(robots)]
    return Fleet.model_validate({"separation_m": separation, "fleet": named})


def patrol(*points: list[float], **more: Any) -> dict[str, Any]:
    return {"route": {"start": points[0], "via": list(points[1:]), "closed": True}, **more}


def ride(start: list[float], goal: list[float], *via: list[float], **more: Any) -> dict[str, Any]:
    return {"route": {"start": start, "via": list(via), "goal": goal}, **more}


def holds_for_ever(plan: FleetPlan) -> None:
    """Its certificate is below what samples meet, whole periods after all others have arrived."""
    assert plan.patrols is not None
    assert plan.certificate.holds
    assert plan.certificate.repeats == (plan.patrols.repeats_from, plan.patrols.period)
    assert nearest(plan) >= plan.fleet.separation_m - 1e-6
    assert nearest(plan) >= plan.certificate.separation - 1e-6


def comes_again(plan: FleetPlan) -> None:
    """The laps that are planned are those of the first period again, as long as is said."""
    assert plan.patrols is not None
    patrols = plan.patrols
    for name, begin in patrols.begins.items():
        one = plan.plans[name]
        times = np.arange(begin, patrols.planned_until, 0.7)
        planned = one.path.at_distance(one.trajectory.distance_at(times))
        phases = begin + (times - begin) % patrols.period
        first = one.path.at_distance(one.trajectory.distance_at(phases))
        assert np.abs(planned - first).max() < 1e-6
        rounds = round(one.mission.route.laps / patrols.laps[name])
        assert begin + rounds * patrols.period >= patrols.planned_until - 1e-6


def test_a_closed_route_without_laps_never_ends_and_one_with_laps_does() -> None:
    endless = plan_fleet(fleet_of({"route": SQUARE}))
    assert endless.patrols is not None
    assert endless.patrols.laps == {"r0": 1}
    assert plan_fleet(fleet_of({"route": {**SQUARE, "laps": 1}})).patrols is None


def test_two_patrols_that_cross_have_one_period_and_never_meet() -> None:
    plan = plan_fleet(fleet_of(patrol([0, 0], [20, 0]), patrol([10, 9], [10, -20])))
    assert plan.served
    holds_for_ever(plan)
    comes_again(plan)
    assert plan.patrols is not None
    lap = max(one.trajectory.duration / one.mission.route.laps for one in plan.plans.values())
    assert plan.patrols.period == pytest.approx(lap, rel=0.1)


def test_a_short_lap_is_driven_several_times_in_a_period() -> None:
    plan = plan_fleet(fleet_of(patrol([0, 0], [12, 0]), patrol([6, 9], [6, -60])))
    assert plan.served
    assert plan.patrols is not None
    assert plan.patrols.laps["r0"] > plan.patrols.laps["r1"] == 1
    holds_for_ever(plan)
    comes_again(plan)


def test_a_period_gets_longer_where_patrols_share_a_narrow_way() -> None:
    # Both drive up and down the same line, one from either side, with room for one of them.
    plan = plan_fleet(
        fleet_of(
            patrol([0, 4], [0, 0], [40, 0], [0, 0.5]), patrol([40, 4], [40, 0], [1, 0], [40, 0.5])
        )
    )
    assert plan.served
    holds_for_ever(plan)
    assert plan.patrols is not None
    alone = [plan_alone(one.mission).trajectory.duration for one in plan.fleet.members]
    assert plan.patrols.period > 1.2 * max(alone)


def test_a_robot_that_ends_passes_a_patrol_between_two_of_its_laps() -> None:
    plan = plan_fleet(fleet_of({"route": SQUARE}, ride([6, -3], [6, 23], [6, 10])))
    assert plan.served
    holds_for_ever(plan)


def test_a_robot_drives_over_the_start_of_a_patrol_that_is_away() -> None:
    plan = plan_fleet(fleet_of({"route": SQUARE}, ride([-20, -20], [-20, 20], [0, 0])))
    assert plan.served
    holds_for_ever(plan)


def test_a_patrol_waits_for_a_robot_that_starts_on_its_route() -> None:
    late = ride([20, 20], [60, 20], depart_s=90)
    plan = plan_fleet(fleet_of({"route": SQUARE}, late))
    assert plan.served
    assert plan.patrols is not None
    assert plan.patrols.begins["r0"] > 60.0
    holds_for_ever(plan)


def test_a_patrol_that_passes_the_start_of_another_is_not_served_and_told_why() -> None:
    plan = plan_fleet(fleet_of({"route": SQUARE}, patrol([20, 20], [40, 20], [40, 40])))
    (refused,) = plan.not_served
    assert refused.name == "r0"
    assert "comes back to its start every lap" in refused.reason
    assert "start" in refused.remedy
    assert plan.certificate.holds


def test_of_patrols_that_pass_each_others_starts_nothing_is_tried_though_none_is_served() -> None:
    behind = patrol([20, 20], [0, 20], [0, 0], [20, 0])
    plan = plan_fleet(fleet_of({"route": SQUARE}, behind))
    assert [one.name for one in plan.not_served] == ["r0", "r1"]
    for one in plan.not_served:
        assert "comes back to its start every lap" in one.reason
        assert "start" in one.remedy


def test_a_robot_that_would_stay_where_a_patrol_passes_is_not_served_but_may_leave() -> None:
    stays = plan_fleet(fleet_of({"route": SQUARE}, ride([20, -20], [20, 20])))
    (refused,) = stays.not_served
    assert refused.name == "r1"
    assert "leave" in refused.remedy
    leaves = plan_fleet(fleet_of({"route": SQUARE}, ride([20, -20], [20, 20], rest="leave")))
    assert leaves.served
    holds_for_ever(leaves)


def test_a_patrol_gives_in_where_a_robot_stands_on_its_route_for_good() -> None:
    home = {"route": {"start": [20, 20], "via": [[40, 20], [40, 40]], "closed": True, "laps": 1}}
    plan = plan_fleet(fleet_of({"route": SQUARE}, home))
    assert [one.name for one in plan.not_served] == ["r0"]
    assert plan.certificate.holds


def test_a_patrol_gives_in_where_a_robot_that_is_not_served_stands_on_its_route() -> None:
    # The second robot would stay on the way of the first patrol, and starts on that of the other.
    far = {"start": [60, 0], "via": [[80, 0], [80, 20], [60, 20]], "closed": True}
    plan = plan_fleet(fleet_of({"route": SQUARE}, {"route": far}, ride([80, 0], [20, 20])))
    assert {one.name for one in plan.not_served} == {"r1", "r2"}
    assert plan.certificate.holds
    assert nearest(plan) >= 0.5 - 1e-6


def test_improving_leaves_patrols_as_they_are() -> None:
    robots = [patrol([0, 0], [20, 0]), patrol([10, 9], [10, -20])]
    robots += [ride([x, 12], [x, -9], rest="leave") for x in (3, 6, 14, 17)]
    plan = plan_fleet(fleet_of(*robots), improve=0.05)
    assert plan.served
    holds_for_ever(plan)
    comes_again(plan)


def test_the_law_of_a_patrol_with_a_limit_of_its_jerk_keeps_that_limit() -> None:
    kind = {"robots": {"soft": {"max_jerk_mps3": 0.5}}}
    robot = patrol([0, 0], [20, 0], [20, 20], robot="soft", depart_s=3, name="p")
    plan = plan_fleet(Fleet.model_validate({**kind, "fleet": [robot]}))
    law = plan.plans["p"].trajectory
    times = np.arange(law.start_time, law.end_time, 0.05)
    along, speeds, _ = law.state_at(times)
    assert law.start_time == 3.0
    assert np.abs(np.diff(along) / 0.05 - 0.5 * (speeds[1:] + speeds[:-1])).max() < 1e-3
    rises = np.diff(speeds) / 0.05
    assert np.abs(rises).max() <= 1.0 + 1e-6
    assert np.abs(np.diff(rises)).max() / 0.05 <= 0.5 * 1.1
    holds_for_ever(plan)
    comes_again(plan)


def test_plans_hold_as_many_periods_as_are_asked_for() -> None:
    asked = fleet_of(patrol([0, 0], [20, 0]), patrol([10, 9], [10, -20]))
    plan = plan_fleet(asked, periods=5)
    assert plan.patrols is not None
    assert plan.patrols.planned_until >= plan.patrols.repeats_from + 5 * plan.patrols.period
    assert plan.plans["r0"].mission.route.laps >= 5
    comes_again(plan)


def test_priority_alone_times_patrols_as_well() -> None:
    asked = fleet_of({"route": SQUARE}, ride([6, -3], [6, 23], [6, 10]))
    plan = plan_by_priority(asked, crossing_paths(asked))
    assert plan.served
    holds_for_ever(plan)


coordinates = st.integers(0, 30).map(lambda n: n + 0.7)
spots = st.tuples(coordinates, coordinates).map(list)


@st.composite
def fleets(draw: st.DrawFn) -> Fleet:
    """Patrols and robots that end, whose starts are at least 4 m apart."""
    count = draw(st.integers(2, 4))
    starts = draw(
        st.lists(
            st.tuples(st.integers(0, 6), st.integers(0, 6)), min_size=count, max_size=count,
            unique=True,
        )
    )  # fmt: skip
    goals = draw(
        st.lists(
            st.tuples(st.integers(0, 6), st.integers(0, 6)), min_size=count, max_size=count,
            unique=True,
        )
    )  # fmt: skip
    robots = []
    for k, (start, goal) in enumerate(zip(starts, goals, strict=True)):
        begin, end = [5.0 * start[0], 5.0 * start[1]], [5.0 * goal[0] + 2.5, 5.0 * goal[1] + 2.5]
        via = draw(st.lists(spots, min_size=1, max_size=2, unique_by=tuple))
        depart = draw(st.sampled_from([0.0, 0.0, 7.0, 60.0]))
        if k == 0 or draw(st.booleans()):
            robots.append(patrol(begin, *via, end, depart_s=depart))
        else:
            rest = draw(st.sampled_from(["stay", "leave"]))
            robots.append(ride(begin, end, *via, depart_s=depart, rest=rest))
    return fleet_of(*robots)


@settings(max_examples=25, deadline=None)
@given(fleets(), st.sampled_from([0.0, 0.002]))
def test_whatever_is_served_keeps_apart_for_ever(asked: Fleet, improve: float) -> None:
    plan = plan_fleet(asked, improve)
    assert plan.certificate.holds
    if plan.patrols is None:
        assert nearest(plan) >= asked.separation_m - 1e-6
    else:
        holds_for_ever(plan)
        comes_again(plan)
    told = {one.name for one in plan.not_served}
    assert told | set(plan.plans) == {one.name for one in asked.members}


@settings(max_examples=15, deadline=None)
@given(fleets(), st.integers(0, 1000))
def test_patrols_that_are_delayed_stay_apart_and_come_home(asked: Fleet, seed: int) -> None:
    plan = plan_fleet(asked)
    run = simulate_fleet(asked, Delays(slowed=0.3, halts=1, halts_s=30), plan, seed=seed)
    assert run.certificate.holds
    assert run.deadlock == ()
    assert set(run.arrivals) == set(plan.plans)
    endless = set() if plan.patrols is None else set(plan.patrols.begins)
    assert set(run.delays) == set(plan.plans) - endless


def test_nobody_is_late_for_resting_between_two_rounds() -> None:
    plan = plan_fleet(fleet_of(patrol([0, 0], [20, 0]), patrol([0, 30], [35, 30])))
    assert plan.patrols is not None
    assert plan.patrols.laps == {"r0": 1, "r1": 1}
    assert [one.late for one in timelines_of(plan)] == pytest.approx([0.0, 0.0], abs=1e-6)
    assert [one.waits for one in timelines_of(plan)] == [(), ()]


@settings(max_examples=8, deadline=None)
@given(dwell=st.floats(0.5, 20.0), laps=st.integers(0, 2), separation=st.floats(0.0, 1.0))
def test_a_patrol_stands_at_its_start_once_a_lap(
    dwell: float, laps: int, separation: float
) -> None:
    start = {"at": [0, 0], "dwell_s": dwell}
    route = {"start": start, "via": [[20, 0], [20, 20]], "closed": True}
    alone = plan_alone(fleet_of({"route": {**route, "laps": 1}}).members[0].mission)
    others = [ride([10, -10], [10, 30]), patrol([10, 40], [10, 8])][: laps + 1]
    plan = plan_fleet(fleet_of({"route": route}, *others, separation=separation))
    assert plan.served
    assert plan.patrols is not None
    law, path = plan.plans["r0"].trajectory, plan.plans["r0"].path
    lap = path.length / plan.plans["r0"].mission.route.laps
    if len(others) == 1:  # nobody else sets the period
        assert plan.patrols.period == pytest.approx(alone.trajectory.duration - dwell)
    for k in range(1, plan.plans["r0"].mission.route.laps + 1):
        stood = np.ptp(law.times[np.abs(law.distances - k * lap) < 1e-6])
        assert stood >= dwell - 1e-6
    with tempfile.TemporaryDirectory() as folder:
        plan.save(folder)
        assert load_fleet_plan(folder) == plan


@pytest.mark.parametrize("speed", [0.1, 0.2])
def test_who_finds_no_gap_between_laps_is_told_so_after_a_few_periods(
    speed: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Laps aren't laid out for it, more and more, until there are too many for everybody."""
    laid_out = []

    def counted(*given: Any) -> Any:
        laid_out.append(given[-1])
        return unrolled(*given)

    monkeypatch.setattr("viaspline.fleet.patrols.timed_patrols.unrolled", counted)
    quick, slow = ({"radius_m": 0.4, "max_speed_mps": most} for most in (3.0, speed))
    robots = [
        {"name": "to and fro", "robot": "quick", **patrol([4, 0], [14, 0])},
        {"name": "slow", "robot": "slow", **ride([9, -6], [9, 6])},
        {"name": "apart", "robot": "quick", **ride([0, 20], [20, 20])},
    ]
    fleet = {"separation_m": 0.5, "robots": {"quick": quick, "slow": slow}, "fleet": robots}
    plan = plan_fleet(Fleet.model_validate(fleet))
    assert set(plan.plans) == {"to and fro", "apart"}
    (missing,) = plan.not_served
    assert (missing.name, missing.obstacles) == ("slow", ("to and fro",))
    assert "finds no time between the laps of 'to and fro'" in missing.reason
    assert missing.where is not None
    path = plan.plans["to and fro"].path
    places = np.asarray(path.at_distance(np.linspace(0.0, path.length, 4000)))
    assert np.hypot(*(places - missing.where).T).min() < 0.4 + 0.5 + 0.4 + 0.02
    assert len(laid_out) <= 4


def test_who_has_to_let_a_patrol_pass_twice_sets_out_in_a_later_gap_between_its_laps() -> None:
    """Its way is one crossing with that of the patrol, and another one passes its goal first.

    Found by transformed_fleets.py (2 320): it waited until all laps were over, and was given up.
    """
    posts = [([7.56, 19.9], 1.01), ([8.58, 9.35], 1.29), ([11.45, 12.01], 0.87)]
    slow = {"radius_m": 0.6, "clearance_m": 0.1, "max_speed_mps": 0.6, "max_accel_mps2": 0.3}
    stops = [{"at": at, "dwell_s": 4.0} for at in ([6.16, 16.68], [12.63, 23.97])]
    round_trip = patrol([20.46, 18.79], [9.8, 22.16], [1.7, 20.14])
    fleet = Fleet.model_validate(
        {
            "separation_m": 1.0,
            "world": {"known": [{"circle": {"center": at, "radius": r}} for at, r in posts]},
            "robots": {"slow": slow},
            "fleet": [
                {"name": "r0", "rest": "leave", "priority": 1,
                 "route": {"start": [23.61, 1.01], "via": stops, "goal": [21.78, 0.43]}},
                {"name": "r1", "rest": "leave", "priority": 5, **round_trip},
                {"name": "r3", "priority": 3, "depart_s": 20,
                 "route": {"start": [18.34, 19.91], "goal": [6.29, 15.1]}},
            ],
        }
    )  # fmt: skip
    plan = plan_fleet(fleet)
    assert plan.served
    assert nearest(plan) >= 1.0 - 1e-6
