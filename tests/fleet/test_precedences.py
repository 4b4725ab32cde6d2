"""Who passes first, and for whom the others are late."""

from __future__ import annotations

import pytest

import viaspline as vs
from viaspline.fleet.fleet_plan import FleetPlan


@pytest.fixture(scope="module")
def planned() -> FleetPlan:
    """One that lets two pass that come one after the other, on lanes 10 m apart."""
    lanes = [
        {"name": f"east {k}", "priority": 1, "depart_s": 5 * k,
         "route": {"start": [-20, 10 * k], "goal": [40, 10 * k]}}
        for k in (0, 1)
    ]  # fmt: skip
    north = {"name": "north", "route": {"start": [0, -22], "goal": [0, 40]}}
    return vs.plan_fleet(vs.Fleet.model_validate({"separation_m": 1, "fleet": [*lanes, north]}))


def test_each_crossing_has_one_who_passes_first_and_where(planned: FleetPlan) -> None:
    assert [(one.first, one.second) for one in planned.precedences] == [
        ("east 0", "north"), ("east 1", "north"),
    ]  # fmt: skip
    for k, one in enumerate(planned.precedences):
        assert one.leaves_at == pytest.approx(22.0, abs=0.3)  # 2 m after the middle of the crossing
        assert one.enters_at == pytest.approx(20.0 + 10.0 * k, abs=0.3)


def test_waits_for_all_that_one_lets_pass_are_all_that_it_is_late(planned: FleetPlan) -> None:
    late = planned.plans["north"].trajectory.duration - planned.alone["north"]
    waits = [one.waits_s for one in planned.precedences]
    assert late > 0.3
    assert sum(waits) == pytest.approx(late, abs=0.01)
    assert waits[0] > 0.0


def test_robots_that_have_no_plan_pass_nobody() -> None:
    robots = [
        {"name": name, "route": {"start": [start, 0], "goal": [goal, 0]}}
        for name, start, goal in (("a", 0, 20), ("b", 20, 0), ("c", 14, 9))
    ]
    asked = {"world": {"bounds": [-1, -1.05, 21, 1.05]}, "separation_m": 0.3, "fleet": robots}
    plan = vs.plan_fleet(vs.Fleet.model_validate(asked))
    assert set(plan.plans) == {"c"}
    assert plan.precedences == ()
