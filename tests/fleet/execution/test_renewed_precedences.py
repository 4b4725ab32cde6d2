"""Who passes first in a plan that one robot changed: what is looked up is what is found anew."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.errors import PlanningError
from viaspline.fleet.execution.changed_plans import add_robot, reroute_robot
from viaspline.fleet.ordered_crossings import ordered_crossings
from viaspline.fleet.precedences import Precedence, precedences_of
from viaspline.mission.fleet.fleet import FleetMember

KINDS = {"cart": {"radius_m": 0.5, "max_speed_mps": 2.0}}


def routes(seed: int, count: int) -> list[dict[str, Any]]:
    """Straight ways through the middle of a place, from many sides."""
    rng = np.random.default_rng(seed)
    found = []
    for k in range(count):
        way = np.pi * (k + rng.uniform(0.35, 0.65)) / count
        end = 30.0 * np.array([np.cos(way), np.sin(way)]) * rng.choice([-1.0, 1.0])
        aside = rng.uniform(-1.5, 1.5) * np.array([-np.sin(way), np.cos(way)])
        ends = {"start": (end + aside).tolist(), "goal": (aside - 0.8 * end).tolist()}
        found.append({**ends, "depart_s": float(rng.uniform(0.0, 6.0))})
    return found


def members(seed: int, count: int) -> tuple[FleetMember, ...]:
    robots = [{"name": f"r{k}", "route": way} for k, way in enumerate(routes(seed, count))]
    fleet = {"separation_m": 0.5, "robots": KINDS, "fleet": robots}
    return vs.Fleet.model_validate(fleet).members


def found_anew(plan: vs.FleetPlan) -> tuple[Precedence, ...]:
    crossings = ordered_crossings(plan.courses, plan.crossings, plan.laws)
    for one, two in zip(crossings.packed, plan.crossings.packed, strict=True):
        assert one.tolist() == two.tolist()
    return precedences_of(plan.courses, crossings, plan.laws, plan.rides.laws)


@given(seed=st.integers(0, 10_000), count=st.integers(3, 9), reroute=st.booleans())
@example(seed=1, count=8, reroute=False)
@example(seed=2, count=8, reroute=True)
@settings(max_examples=12, deadline=None)
def test_they_are_those_of_all_crossings_looked_at_anew(
    seed: int, count: int, reroute: bool
) -> None:
    robots = members(seed, count)
    plan = vs.plan_fleet(vs.Fleet.of(robots[:-1], 0.5))
    assert found_anew(plan) == plan.precedences
    try:
        if reroute:
            other = reroute_robot(plan, FleetMember(robots[0].name, robots[-1].mission))
        else:
            other = add_robot(plan, robots[-1])
    except PlanningError:
        return
    assert found_anew(other) == other.precedences
    kept = {id(one) for one in plan.precedences}
    same = [one for one in other.precedences if id(one) in kept]
    assert reroute or len(same) + count > len(plan.precedences) / 2


def test_a_robot_that_waits_for_a_new_one_no_longer_waits_for_it() -> None:
    """What a robot is late by is told of whom it waits for, as long as that one is there."""
    robots = members(1, 8)
    plan = vs.plan_fleet(vs.Fleet.of(robots[:-1], 0.5))
    more = add_robot(plan, robots[-1])
    assert any("r7" in (one.first, one.second) for one in more.precedences)
    assert sum(one.waits_s for one in more.precedences) > 0.0
    back = vs.remove_robot(more, "r7")
    assert [(one.first, one.second) for one in back.precedences] == [
        (one.first, one.second) for one in plan.precedences
    ]
    assert [one.waits_s for one in back.precedences] == pytest.approx(
        [one.waits_s for one in plan.precedences]
    )
