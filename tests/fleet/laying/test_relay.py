from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.errors import PlanningError
from viaspline.fleet.laying.laying_work import LayingWork
from viaspline.fleet.laying.relay import relay
from viaspline.fleet.laying.relay_paths import relay_paths
from viaspline.mission.fleet.fleet import Fleet
from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan, plan_in
from viaspline.planning.problem.work_budget import WorkBudget
from viaspline.world.world import World

APART = 2.0
LAST_STEP_S = 0.5
"""What a step that was begun may cost more than there was [s]."""
CART = {
    "radius_m": 0.5, "clearance_m": 0.1, "max_speed_mps": 2, "max_accel_mps2": 1,
    "max_lateral_accel_mps2": 0.8,
}  # fmt: skip


def fleet(*ends: tuple[Any, Any], world: Any = None, **more: Any) -> Fleet:
    members = [
        {
            "name": f"r{k}",
            "robot": "cart",
            "route": {"start": a, "goal": b},
            **more.get(f"r{k}", {}),
        }
        for k, (a, b) in enumerate(ends)
    ]
    return Fleet.model_validate(
        {"separation_m": 1.0, "robots": {"cart": CART}, "world": world or {}, "fleet": members}
    )


def least_distance(plans: dict[str, Plan]) -> float:
    """Of any two robots, at instants 20 ms apart; all stand before and after their drives."""
    end = max(plan.trajectory.end_time for plan in plans.values())
    times = np.arange(-1.0, end + 1.0, 0.02)
    places = [
        np.asarray(plan.path.at_distance(plan.trajectory.distance_at(times)))
        for plan in plans.values()
    ]
    return min(float(np.hypot(*(a - b).T).min()) for k, a in enumerate(places) for b in places[:k])


def on_a_circle(count: int, radius: float) -> list[list[float]]:
    turns = [2.0 * math.pi * k / count for k in range(count)]
    return [[radius * math.cos(turn), radius * math.sin(turn)] for turn in turns]


def test_two_robots_swap_their_places() -> None:
    found = relay_paths(fleet(([0, 0], [30, 0]), ([30, 0], [0, 0])), {}, ["r0", "r1"])
    assert not found.not_served
    assert least_distance(found.plans) >= APART
    assert found.plans["r1"].trajectory.end_time < 20.0


def test_of_two_robots_in_a_corridor_one_waits_in_the_bay() -> None:
    upper = [[-3, 1.2], [14, 1.2], [14, 5.2], [19.5, 5.2], [19.5, 1.2], [43, 1.2], [43, 7], [-3, 7]]
    lower = [[-3, -2.2], [43, -2.2], [43, -1.2], [-3, -1.2]]
    world = {"bounds": [-3, -2.2, 43, 7], "known": [{"polygon": upper}, {"polygon": lower}]}
    found = relay_paths(fleet(([0, 0], [40, 0]), ([40, 0], [0, 0]), world=world), {}, ["r0", "r1"])
    assert not found.not_served
    assert least_distance(found.plans) >= APART
    lines = [one.path.evaluate(np.linspace(*one.path.domain, 900)) for one in found.plans.values()]
    assert max(line[:, 1].max() for line in lines) > 2.0
    assert all(plan.certificate.holds for plan in found.plans.values())


@pytest.mark.parametrize("count", [3, 8])
def test_a_ring_of_robots_that_each_want_the_next_ones_place_is_served(count: int) -> None:
    places = on_a_circle(count, 10.0)
    ring = fleet(*zip(places, places[1:] + places[:1], strict=True))
    found = relay_paths(ring, {}, [one.name for one in ring.members])
    assert not found.not_served
    assert least_distance(found.plans) >= APART


@pytest.mark.slow
def test_robots_that_cross_a_circle_through_its_middle_are_served() -> None:
    places = on_a_circle(6, 10.0)
    crossing = fleet(*zip(places, places[3:] + places[:3], strict=True))
    found = relay_paths(crossing, {}, [one.name for one in crossing.members])
    assert not found.not_served
    assert least_distance(found.plans) >= APART


def test_laying_again_gives_the_same_bytes() -> None:
    asked = fleet(([0, 0], [30, 0]), ([30, 0], [0, 0]))
    one, two = (relay_paths(asked, {}, ["r0", "r1"]).plans["r1"] for _ in range(2))
    assert one.path.spans.tobytes() == two.path.spans.tobytes()
    assert one.trajectory.times.tobytes() == two.trajectory.times.tobytes()


def test_the_law_begins_when_the_robot_departs() -> None:
    asked = fleet(([0, 0], [30, 0]), r0={"depart_s": 7.0})
    assert relay(asked, asked.members[0], {}).trajectory.start_time == 7.0


def test_who_is_run_over_before_it_may_depart_is_refused_with_the_remedy() -> None:
    asked = fleet(([0, 0], [60, 0]), ([30, 0], [30, 20]), r1={"depart_s": 60.0})
    blind = fleet(([0, 0], [60, 0]))
    first = relay(blind, blind.members[0], {})
    with pytest.raises(PlanningError, match="'r0' comes by its start") as refused:
        relay(asked, asked.members[1], {"r0": first})
    assert refused.value.obstacles == ("r0",)
    assert "depart_s" in refused.value.remedy


def test_who_is_in_the_way_of_one_without_a_path_is_laid_after_it() -> None:
    walls = [[[-3, y], [43, y], [43, y + 1], [-3, y + 1]] for y in (1.2, -2.2)]
    world = {"bounds": [-3, -2.2, 43, 2.2], "known": [{"polygon": wall} for wall in walls]}
    asked = fleet(([10, 0], [20, 0]), ([0, 0], [40, 0]), world=world)
    found = relay_paths(asked, {}, ["r0", "r1"])
    assert len(found.plans) == 1
    (left,) = found.not_served
    assert left.reason
    assert left.remedy


def test_robots_in_each_others_way_are_not_laid_twice_among_the_same(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """They took turns, and each turn was laid anew: half of a minute in a corridor."""
    walls = [[[-3, y], [43, y], [43, y + 1], [-3, y + 1]] for y in (1.2, -2.2)]
    world = {"bounds": [-3, -2.2, 43, 2.2], "known": [{"polygon": wall} for wall in walls]}
    ends = ([10, 0], [30, 0]), ([0, 0], [40, 0]), ([36, 0], [4, 0])
    laid = []

    def counted(mission: Mission, world: World, spending: WorkBudget) -> Plan:
        laid.append((mission, len(world)))
        return plan_in(mission, world, spending)

    monkeypatch.setattr("viaspline.fleet.laying.relay.plan_in", counted)
    found = relay_paths(fleet(*ends, world=world), {}, ["r0", "r1", "r2"])
    assert found.not_served
    assert len(laid) == len(set(laid)) > 3


SWAP = ([0, 0], [30, 0]), ([30, 0], [0, 0])


def test_what_was_laid_among_the_same_robots_costs_nothing_another_time() -> None:
    asked, work = fleet(*SWAP), LayingWork.of(40.0)
    first = relay_paths(asked, {}, ["r0", "r1"], work=work)
    spent = work.budget.spent
    again = relay_paths(asked, {}, ["r0", "r1"], work=work)
    assert 0.0 < spent == work.budget.spent
    assert again.plans == first.plans


def test_robots_among_which_all_was_spent_give_up_and_are_told_what_would_help() -> None:
    asked, work = fleet(*SWAP), LayingWork.of(0.1)
    found = relay_paths(asked, {}, ["r0", "r1"], work=work)
    assert not found.plans
    assert [one.outcome for one in found.not_served] == ["gave up"] * 2
    assert all("priority" in one.remedy for one in found.not_served)


@settings(max_examples=10, deadline=None)
@given(seconds=st.floats(0.0, 3.0), count=st.integers(2, 5))
def test_a_fleet_spends_no_more_than_it_may_but_for_a_last_step(seconds: float, count: int) -> None:
    places = on_a_circle(count, 8.0)
    ring = fleet(*zip(places, places[1:] + places[:1], strict=True))
    works = [LayingWork.of(seconds) for _ in range(2)]
    names = [one.name for one in ring.members]
    one, two = (relay_paths(ring, {}, names, work=work) for work in works)
    assert works[0].budget.spent <= seconds + count * LAST_STEP_S
    assert works[0].budget.spent == works[1].budget.spent
    assert one.plans == two.plans
    assert all(left.outcome == "gave up" for left in one.not_served)


def test_what_a_robot_needs_beside_one_path_is_kept_on_the_next_at_once() -> None:
    cart = {**CART, "drive": {"differential": {"track_m": 0.5}, "lag_s": 0.2}}
    data = {"separation_m": 1.0, "robots": {"cart": CART, "driven": cart}}
    ends = [{"name": f"r{k}", "robot": "driven", "route": {"start": a, "goal": b}}
            for k, (a, b) in enumerate(SWAP)]  # fmt: skip
    asked = Fleet.model_validate({**data, "fleet": ends})
    known = {one.name: plan(one.mission) for one in asked.members}
    found = relay_paths(asked, {}, ["r0", "r1"], known, LayingWork.of(40.0))
    assert not found.not_served
    assert least_distance(found.plans) >= APART
    for name, one in found.plans.items():
        assert one.tracking_error >= known[name].tracking_error > 0.0


def test_who_was_laid_before_all_was_spent_is_still_served_by_that() -> None:
    asked, work = fleet(*SWAP), LayingWork.of(40.0)
    first = relay_paths(asked, {}, ["r0", "r1"], work=work)
    work.budget.spent = work.budget.limit
    again = relay_paths(asked, {}, ["r0", "r1"], work=work)
    assert not again.not_served
    assert again.plans == first.plans
