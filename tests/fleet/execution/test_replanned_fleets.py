"""Fleets under way that get a robot more, or others ways for some: all arrive, far enough apart."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from stepped_fleets import APART_M, ASIDE, CROSS, PERIOD_S, Drive, fleet, member, start

import viaspline as vs
from viaspline.errors import GaveUpError, GeometryError, PlanningError
from viaspline.fleet.execution.ways_from_rest import rest_of_route
from viaspline.mission.route_spec import Route


def test_a_robot_that_is_added_under_way_passes_the_others_and_nobody_else_is_touched() -> None:
    drive = start(*CROSS, ASIDE)
    drive.until(6.0)
    before, _ = drive.nav.step([], drive.time)
    drive.take(drive.nav.with_robot(member("new", {"start": [30, -20], "goal": [30, 20]})))
    assert [(one.kind, one.name) for one in drive.nav.events][-1] == ("added", "new")
    after, _ = drive.nav.step([], drive.time)
    assert {name: after[name] for name in before} == before
    drive.until(120.0)
    assert drive.nav.reached
    assert drive.nearest >= APART_M


def test_a_robot_is_not_put_before_one_that_was_let_in_already() -> None:
    """r0 may go on to its goal: who crosses its path waits until it has passed."""
    drive = start(*CROSS)
    drive.until(1.0)
    nav = drive.nav.with_robot(member("new", {"start": [10, -2.5], "goal": [10, 20]}))
    commands, _ = nav.step([], drive.time)
    assert commands["r0"].granted == pytest.approx(40.0)
    assert commands["new"].waits_for == "r0"


def test_a_robot_that_joins_may_set_out_before_its_law_does_and_is_believed() -> None:
    """Its law waits at its start until r0 has passed; by its grant it waits before r0's way."""
    drive = start(*CROSS)
    drive.until(2.0)
    nav = drive.nav.with_robot(member("new", {"start": [12, -3], "goal": [12, 15]}))
    commands, nav = nav.step([], 2.0)
    let = commands["new"].granted
    assert 0.3 < let < 2.0
    commands, nav = nav.step([vs.ProgressReport("new", 4.0, let, 0.0)], 4.0)
    assert not [one for one in nav.events if one.kind == "refused"]
    assert nav.progress["new"] == let
    drive.take(nav)
    drive.time, drive.place["new"], drive.holds["new"] = 4.5, let, let
    drive.until(60.0)
    assert drive.nav.reached
    assert drive.nearest >= APART_M - 1e-6


def test_a_robot_that_is_to_rest_on_anothers_way_passes_before_it_or_is_refused() -> None:
    drive = start(*CROSS)
    drive.until(1.0)
    with pytest.raises(PlanningError) as found:
        drive.nav.with_robot(member("new", {"start": [30, -5], "goal": [30, 0]}))
    assert "r0" in found.value.obstacles
    with pytest.raises(GeometryError, match="there is a robot 'r0' already"):
        drive.nav.with_robot(member("r0", ASIDE))


def test_a_robot_is_sent_elsewhere_from_where_it_was_asked_to_stop() -> None:
    drive = start(*CROSS, ASIDE)
    drive.until(6.0)
    other = Route.model_validate({"start": [0, 0], "via": [[20, 30]], "goal": [0, 30]})
    with pytest.raises(GeometryError, match=r"r2 drives, or may set out .* stopping\('r2'\)"):
        drive.nav.rerouted("r2", other)
    drive.take(drive.nav.stopping("r2"))
    stopped_at = drive.nav.events[-1].at_m
    drive.until(14.0)
    assert drive.place["r2"] == pytest.approx(stopped_at, abs=0.05)
    before, _ = drive.nav.step([], drive.time)
    drive.take(drive.nav.rerouted("r2", other))
    after, _ = drive.nav.step([], drive.time)
    assert {name: after[name] for name in ("r0", "r1")} == {n: before[n] for n in ("r0", "r1")}
    assert after["r2"].path == 1
    drive.until(120.0)
    assert drive.nav.reached
    assert drive.at["r2"] == pytest.approx([0.0, 30.0])
    assert drive.nearest >= APART_M


def test_who_is_sent_onto_the_way_of_one_that_waits_for_it_lets_that_one_pass() -> None:
    """It was to pass first, for the other one never came: there it stood for good, and was hit."""
    drive = start(*CROSS)
    drive.until(4.0)
    drive.take(drive.nav.stopping("r0"))
    drive.until(7.0)
    assert drive.step()["r1"].waits_for == "r0"
    there = Route.model_validate({"start": [0, 0], "goal": [20, 12]})
    drive.take(drive.nav.rerouted("r0", there))
    drive.until(120.0)
    assert drive.nav.reached
    assert drive.nearest >= APART_M - 1e-6
    assert np.allclose(drive.at["r0"], [20, 12], atol=0.1)


@settings(max_examples=8, deadline=None)
@given(st.floats(3.15, 3.4), st.floats(0.0, 0.95))
def test_who_is_sent_elsewhere_is_kept_away_from_up_to_where_it_may_creep_meanwhile(
    apart: float, share: float
) -> None:
    """It stands short of what it is granted, before one that comes near the end of that only."""
    cart, kept = {"radius_m": 0.3, "max_speed_mps": 2.0}, 3.3
    found = vs.Fleet.model_validate({
        "separation_m": 1.0, "robots": {"small": cart, "big": {**cart, "radius_m": 2.0}}, "fleet": [
            {"name": "first", "robot": "small", "route": {"start": [10, 0], "goal": [60, 0]}},
            {"name": "big", "robot": "big", "route": {"start": [20, -20], "goal": [20, 20]}},
            {"name": "third", "robot": "small", "rest": "leave", "route": {
                "start": [34, -12], "depart_s": 25.0,
                "goal": [20 + 0.866 * apart, -3.659 + 0.5 * apart],
            }},
        ],
    })  # fmt: skip
    nav = vs.FleetNavigator(vs.plan_fleet(found), stops_within_m=0.1, warm=False)
    late = [vs.ProgressReport("first", 0.0, 0.0), vs.ProgressReport("third", 0.0, 0.0)]
    commands, nav = nav.step([*late, vs.ProgressReport("big", 0.0, 0.0)], 0.0)
    assert commands["big"].waits_for == "first"
    until = commands["big"].granted
    stands = vs.ProgressReport("big", 20.0, until - 0.1 * share)
    nav = nav.step([stands], 20.0)[1]
    may_be = nav.paths["big"].path.at_distance(np.linspace(stands.distance, until, 11))
    try:
        nav = nav.rerouted("big", Route.model_validate({"start": [0, 0], "goal": [20, -30]}))
    except GaveUpError:  # the third one may be too near already
        assert 0.1 * share > 0.02
    granted = nav.step([], 20.1)[0]["third"].granted
    third = nav.paths["third"].path
    goes = third.at_distance(np.linspace(0.0, min(granted, third.length), 2000))
    assert np.hypot(*np.moveaxis(may_be[:, None] - goes, -1, 0)).min() >= kept


def test_who_was_asked_to_stop_goes_on_when_it_is_told_to() -> None:
    drive = start(*CROSS)
    drive.until(6.0)
    drive.take(drive.nav.stopping("r0"))
    drive.until(40.0)
    assert drive.place["r0"] < 20.0
    drive.take(drive.nav.resumed("r0"))
    drive.until(100.0)
    assert drive.nav.reached
    assert drive.nearest >= APART_M


def test_what_is_left_of_a_route_has_the_via_points_ahead_with_their_dwells() -> None:
    vias = [[10, 0], {"at": [20, 10], "dwell_s": 4}, [30, 0]]
    drive = start(
        {"start": [0, 0], "via": vias, "closed": True}, {"start": [15, -9], "goal": [15, 25]}
    )
    while drive.place["r0"] < 13.0:
        drive.step()
    drive.take(drive.nav.stopping("r0"))
    drive.until(drive.time + 8.0)
    stands = drive.where()["r0"]
    way = [{"at": [20, 10], "dwell_s": 4}, [30, 0]]
    route = Route.model_validate({"start": [0, 0], "via": way, "goal": [0, 0]})
    drive.take(drive.nav.rerouted("r0", route))
    names = [tuple(via.at) for via in drive.nav.paths["r0"].path.vias if via.kind == "user"]
    assert names[1:] == [(20.0, 10.0), (30.0, 0.0), (0.0, 0.0)]
    assert names[0] == pytest.approx(tuple(stands))
    waits = []
    while not drive.nav.reached and drive.time < 150.0:
        waits.append(drive.step()["r0"].stands_until)
    assert drive.nav.reached
    assert len({one for one in waits if one is not None}) == 1
    assert drive.nearest >= APART_M


def test_without_a_plan_there_is_nothing_to_lay_a_path_from() -> None:
    from viaspline.fleet.execution.driven_fleet import driven_fleet_of

    nav = vs.FleetNavigator.of(driven_fleet_of(vs.plan_fleet(fleet(*CROSS))))
    with pytest.raises(GeometryError, match="has no FleetPlan"):
        nav.with_robot(member("new", ASIDE))
    with pytest.raises(GeometryError, match="has no FleetPlan"):
        _ = nav.paths


@given(seed=st.integers(0, 1000))
@settings(max_examples=6, deadline=None)
def test_whoever_dies_joins_or_is_sent_elsewhere_the_others_arrive_apart(seed: int) -> None:
    """Six robots across a square: one dies where it is, one more comes, all others arrive."""
    random = np.random.default_rng(seed)
    ends: list[Any] = []
    while len(ends) < 14:
        at = random.uniform(0.0, 50.0, 2)
        if all(np.hypot(*(at - one)) > 5.0 for one in ends):
            ends.append(at)
    pairs = zip(ends[:6], ends[6:12], strict=True)
    routes = [{"start": a.tolist(), "goal": b.tolist()} for a, b in pairs]
    plan = vs.plan_fleet(fleet(*routes))
    drive = Drive(vs.FleetNavigator(plan, period=PERIOD_S))
    served = set(plan.plans)
    drive.until(float(random.uniform(3.0, 20.0)))
    dead = str(random.choice(sorted(served)))
    drive.take(drive.nav.dead(dead, drive.place[dead]))
    try:
        more = {"start": ends[12].tolist(), "goal": ends[13].tolist()}
        drive.take(drive.nav.with_robot(member("more", more)))
    except PlanningError:
        pass  # its start or its goal is in somebody's way
    has_no_way: set[str] = set()
    for _ in range(12):
        drive.until(drive.time + 20.0, dead=(dead,))
        drive.take(drive.nav.replanned())
        has_no_way = {one.name for one in drive.nav.events if one.kind == "has no way"}
        if drive.nav.reached:
            break
    late = set(drive.nav.names) - {dead} - set(drive.nav.blocked)
    late &= served | {"more"}
    arrived = {
        name for name in late if drive.place[name] >= drive.nav.paths[name].path.length - 1e-6
    }
    assert arrived == late
    assert has_no_way <= set(drive.nav.blocked)
    assert drive.nearest >= APART_M - 1e-6


def test_what_is_left_of_several_laps_goes_through_the_start_between_them() -> None:
    route = {"start": [0, 0], "via": [[20, 0], [20, 20]], "closed": True, "laps": 3}
    mission = vs.Mission.model_validate({"route": route})
    path = vs.plan(mission).path
    left = rest_of_route(mission, path, path.length / 3.0 + 1.0)
    assert [via.at for via in left.via] == [(20, 0), (20, 20), (0, 0), (20, 0), (20, 20)]
    assert left.goal is not None
    assert left.goal.at == (0, 0)
    assert not left.closed
