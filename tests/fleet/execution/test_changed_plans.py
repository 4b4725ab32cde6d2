"""Plans with one robot more, one less, or one that goes elsewhere."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from straight_drives import driven_on, timed_lines

import viaspline as vs
from viaspline.errors import GeometryError, PlanningError
from viaspline.fleet.crossings import crossings_of
from viaspline.fleet.execution.changed_plans import add_robot, remove_robot, reroute_robot
from viaspline.fleet.execution.driven_fleet import driven_fleet_of
from viaspline.fleet.execution.fleet_orders import orders_of
from viaspline.fleet.execution.left_fleet import fleet_without
from viaspline.fleet.robots_at_home import certify_all
from viaspline.mission.fleet.fleet import FleetMember

KINDS = {"cart": {"radius_m": 0.5, "clearance_m": 0.1, "max_speed_mps": 2.0}}


def fleet(*routes: Any) -> vs.Fleet:
    robots = [{"name": f"r{k}", "route": route} for k, route in enumerate(routes)]
    return vs.Fleet.model_validate({"separation_m": 1.0, "robots": KINDS, "fleet": robots})


def member(name: str, route: Any) -> FleetMember:
    return FleetMember(name, fleet(route).members[0].mission)


ROUTES = (
    {"start": [0, 0], "goal": [40, 0]},
    {"start": [20, -20], "goal": [20, 20]},
    {"start": [0, 40], "goal": [40, 40]},
)


def nearest(plan: vs.FleetPlan) -> float:
    """The least distance of any two robots, every 10 ms."""
    end = max(one.trajectory.end_time for one in plan.plans.values())
    times = np.arange(-1.0, end + 1.0, 0.01)
    at = [
        np.asarray(one.path.at_distance(one.trajectory.distance_at(times)))[:, :2]
        for one in plan.plans.values()
    ]
    return min(float(np.hypot(*(a - b).T).min()) for k, a in enumerate(at) for b in at[:k])


def test_a_robot_is_added_and_nothing_of_the_others_changes() -> None:
    plan = vs.plan_fleet(fleet(*ROUTES))
    more = add_robot(plan, member("new", {"start": [30, -20], "goal": [30, 20]}))
    assert more.served
    assert tuple(more.plans) == ("r0", "r1", "r2", "new")
    assert all(more.plans[name] is plan.plans[name] for name in plan.plans)
    nodes = len(plan.laws.packed.arrive)
    assert more.laws.packed.arrive[:nodes].tobytes() == plan.laws.packed.arrive.tobytes()
    assert nearest(more) >= 2.0
    assert len(orders_of(driven_fleet_of(more)).sequence()) > 0
    with pytest.raises(GeometryError, match="there is a robot 'r1' already"):
        add_robot(plan, member("r1", ROUTES[0]))


def test_a_new_robot_goes_round_those_who_rest_and_may_not_rest_in_their_way() -> None:
    plan = vs.plan_fleet(fleet(*ROUTES))
    more = add_robot(plan, member("new", {"start": [60, 40], "goal": [20, 43], "depart_s": 90}))
    assert more.plans["new"].path.length > 40.13  # round the goal of r2
    assert more.served
    with pytest.raises(PlanningError):
        add_robot(plan, member("new", {"start": [20, 0], "goal": [60, 60], "depart_s": 90}))


def test_a_robot_is_removed_as_if_it_had_never_been_there() -> None:
    plan = vs.plan_fleet(fleet(*ROUTES))
    more = add_robot(plan, member("new", {"start": [30, -20], "goal": [30, 20]}))
    less = remove_robot(more, "new")
    for kind in ("courses", "crossings", "laws"):
        one, two = getattr(less, kind).packed, getattr(plan, kind).packed
        for a, b in zip(one, two, strict=True):
            assert a.tolist() == b.tolist()
    assert [(one.first, one.second) for one in less.precedences] == [("r0", "r1")]
    assert less.precedences[0].waits_s == pytest.approx(plan.precedences[0].waits_s)
    assert tuple(remove_robot(less, "r0").plans) == ("r1", "r2")
    with pytest.raises(GeometryError, match="no robot 'r9'"):
        remove_robot(less, "r9")
    with pytest.raises(GeometryError, match="is the only robot"):
        remove_robot(vs.plan_fleet(fleet(ROUTES[0])), "r0")


def test_a_robot_is_sent_elsewhere_and_nothing_of_the_others_changes() -> None:
    plan = vs.plan_fleet(fleet(*ROUTES))
    other = reroute_robot(plan, member("r1", {"start": [20, -20], "goal": [20, 60]}))
    assert other.served
    assert other.plans["r1"].path.length == pytest.approx(80.0, abs=1.0)
    assert all(other.plans[name] is plan.plans[name] for name in ("r0", "r2"))
    assert nearest(other) >= 2.0
    with pytest.raises(GeometryError, match="no robot 'r7'"):
        reroute_robot(plan, member("r7", ROUTES[0]))


@given(seed=st.integers(0, 10_000), count=st.integers(2, 7), wide=st.sampled_from([4.0, 40.0]))
@settings(max_examples=10, deadline=None)
def test_what_is_proven_of_a_plan_that_was_changed_is_what_is_proven_of_it_as_a_whole(
    seed: int, count: int, wide: float
) -> None:
    rng = np.random.default_rng(seed)
    ways = [
        {"start": [x, -wide], "goal": [x + float(rng.uniform(-1.5, 1.5)), wide]}
        for x in (6.0 * k for k in range(count + 1))
    ]
    plan = vs.plan_fleet(fleet(*ways[:-1]))
    for change in (add_robot, reroute_robot):
        name = "new" if change is add_robot else f"r{int(rng.integers(count))}"
        try:
            other = change(plan, member(name, ways[-1]))
        except PlanningError:
            continue
        whole = certify_all(other.fleet, other.courses, other.laws)
        assert other.certificate.holds
        assert other.certificate.separation == pytest.approx(whole.separation, abs=1e-3)
        assert other.certificate.repeats is None


@given(seed=st.integers(0, 10_000), count=st.integers(2, 10), which=st.integers(0, 9))
@settings(max_examples=15, deadline=None)
def test_the_crossings_of_those_that_are_left_are_those_found_anew(
    seed: int, count: int, which: int
) -> None:
    whole = driven_on(timed_lines(seed, count))
    whole = replace(whole, crossings=crossings_of(whole.courses))
    left = fleet_without(whole, which % len(whole.names))
    anew = crossings_of(left.courses).packed
    for a, b in zip(left.crossings.packed, anew, strict=True):
        assert a.tolist() == b.tolist()
