"""A plan that is handed in for another mission."""

from __future__ import annotations

from typing import Any

import pytest

import viaspline as vs

ROUTE: dict[str, Any] = {"start": [0, 0], "via": [[10, 8], [20, 0]], "goal": [10, -8]}
ROBOT: dict[str, Any] = {"radius_m": 0.3, "max_speed_mps": 1.0}


def mission(route: dict[str, Any], **robot: Any) -> vs.Mission:
    return vs.Mission.model_validate({"robot": {**ROBOT, **robot}, "route": route})


@pytest.mark.parametrize(
    ("other", "word"),
    [
        (mission(ROUTE, max_speed_mps=2.0), "robot"),
        (mission({**ROUTE, "via": [[10, 8]]}), "route"),
        (mission({**ROUTE, "goal": [10, -9]}), "route"),
    ],
)
def test_a_plan_for_another_robot_or_route_is_not_driven(other: vs.Mission, word: str) -> None:
    made = vs.plan(mission(ROUTE))
    with pytest.raises(vs.GeometryError, match=f"plan is one for another {word}"):
        vs.Navigator(other, made, warm=False)
    with pytest.raises(vs.GeometryError, match=f"plan is one for another {word}"):
        vs.simulate(other, plan=made)


def test_a_plan_that_chose_the_order_is_its_missions() -> None:
    asked = mission({**ROUTE, "via": [[20, 0], [10, 8]], "order": "shortest"})
    made = vs.plan(asked)
    assert [via.at for via in made.mission.route.via] != [via.at for via in asked.route.via]
    assert vs.simulate(asked, plan=made).reached


def test_a_corridor_runs_along_the_order_that_the_plan_chose() -> None:
    """It is beside the lines through the points: those in the order that was asked cross it."""
    lanes = [[20, 0], [0, 6], [20, 6], [0, 12], [0, 3], [20, 12], [20, 3]]
    route = {"start": [0, 0], "via": lanes, "closed": True, "order": "shortest",
             "corridor": {"left_m": 1.5, "right_m": 1.5}}  # fmt: skip
    run = vs.simulate(mission(route))
    assert run.reached, run.reason
    assert run.certificate.holds


def test_what_stands_in_the_way_unseen_may_be_new() -> None:
    made = vs.plan(mission(ROUTE, sensor={"range_m": 6}))
    crate = {"circle": {"center": [5, 5], "radius": 0.5}}
    richer = made.mission.model_copy(
        update={"world": vs.Mission.model_validate(
            {"world": {"unseen": [crate]}, "robot": {**ROBOT, "sensor": {"range_m": 6}},
             "route": ROUTE}
        ).world}
    )  # fmt: skip
    run = vs.simulate(richer, plan=made)
    assert run.reached
    assert run.replans


def test_a_plan_in_the_place_of_a_mission_is_told_how_it_is_driven() -> None:
    made: Any = vs.plan(mission(ROUTE))
    with pytest.raises(vs.GeometryError, match=r"give Navigator\(plan\.mission, plan\)"):
        vs.Navigator(made)


@pytest.mark.parametrize("rate_or_milliseconds", [10, 20, 50])
def test_a_rate_or_milliseconds_are_no_period(rate_or_milliseconds: float) -> None:
    with pytest.raises(vs.GeometryError, match=r"0\.05 for 20 Hz"):
        vs.Navigator(mission(ROUTE), period=rate_or_milliseconds)
