"""Paths in space round the places where other robots are for long."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from viaspline.errors import PlanningError
from viaspline.fleet.laying.laying_workers import ThisProcess
from viaspline.fleet.space.hover_places import HoverPlace, hovers_of
from viaspline.fleet.space.lay_in_space import lay_among_hovers, lay_in_space
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.mission.model import Mission
from viaspline.mission.space.flying_body import FlyingBody
from viaspline.space.plan_spatial import plan_spatial
from viaspline.space.spatial_plan import SpatialPlan

FLAT = {"radius_m": 0.4, "half_height_m": 0.2, "clearance_m": 0.5}
BALL = {"radius_m": 0.5, "clearance_m": 2.0, "tracking_error_m": 0.1}


def alone(robot: dict[str, Any], *points: Any) -> SpatialPlan:
    start, *via, goal = points
    return plan_spatial(Mission.model_validate(
        {"robot": robot, "route": {"start": start, "via": via, "goal": goal}}
    ))  # fmt: skip


def hover(*at: float, kind: Any = "start", body: FlyingBody | None = None) -> HoverPlace:
    return HoverPlace("other", kind, at, body or FlyingBody(0.4, 0.2, 0.0))  # type: ignore[arg-type]


def gap(plan: SpatialPlan, place: HoverPlace) -> float:
    places = np.asarray(plan.path.at_distance(np.linspace(0, plan.path.length, 5000)))
    return float(place.gaps(FlyingBody.of(plan.mission.robot), places).min())


@pytest.mark.parametrize("robot", [FLAT, BALL])
@pytest.mark.parametrize("body", [FlyingBody(0.4, 0.2, 0.0), FlyingBody(0, 0, 0.6)])
def test_a_path_keeps_the_separation_from_who_hovers_in_its_way(
    robot: dict[str, Any], body: FlyingBody
) -> None:
    place = hover(20, 0.2, 10, body=body)
    plan = lay_among_hovers(alone(robot, [0, 0, 10], [40, 0, 10]), [place], 1.5)
    assert gap(plan, place) >= 1.5
    assert plan.certificate.obstacle is None  # it is proven in the world as it is
    assert plan.mission.world.known == ()


def test_a_path_that_passes_nobody_stays_as_it_is() -> None:
    first = alone(FLAT, [0, 0, 10], [40, 0, 10])
    assert lay_among_hovers(first, [hover(20, 0, 13)], 1.5) is first


def test_a_place_at_a_via_point_is_passed_for_it_is_a_matter_of_timing() -> None:
    first = alone(FLAT, [0, 0, 10], [20, 0, 10], [40, 0, 10])
    assert lay_among_hovers(first, [hover(20, 0.5, 10)], 1.5) is first


def test_a_robot_that_can_never_leave_a_via_point_is_not_passed() -> None:
    first = alone(FLAT, [0, 0, 10], [20, 0, 10], [40, 0, 10])
    with pytest.raises(PlanningError):
        lay_among_hovers(first, [hover(20, 0.5, 10, kind="stranded")], 1.5)


def test_a_place_near_the_start_takes_no_more_than_there_is_room() -> None:
    place = hover(0, 2.33, 10)  # 1.53 m of free space at the start
    plan = lay_among_hovers(alone(FLAT, [0, 0, 10], [0, 30, 10]), [place], 1.5)
    assert gap(plan, place) >= 1.5


def test_a_robot_on_a_round_has_one_place_to_rest() -> None:
    around = {"start": [0, 0, 10], "via": [[9, 0, 10], [9, 9, 12]], "closed": True, "laps": 1}
    mission = Mission.model_validate({"robot": FLAT, "route": around})
    member = FleetMember("a", mission)
    assert [one.kind for one in hovers_of(member, plan_spatial(mission))] == ["home"]
    assert [one.kind for one in hovers_of(member, None)] == ["stranded"]


def test_who_leaves_rests_at_its_start_alone() -> None:
    mission = Mission.model_validate(
        {"robot": FLAT, "route": {"start": [0, 0, 10], "goal": [9, 0, 9]}}
    )
    member = FleetMember("a", mission, rest="leave")
    assert [one.kind for one in hovers_of(member, plan_spatial(mission))] == ["start"]


def test_progress_goes_from_nothing_to_all() -> None:
    fleet = Fleet.model_validate({"robots": {"flat": FLAT}, "fleet": [
        {"name": "a", "route": {"start": [0, 0, 9], "goal": [20, 0, 9]}},
        {"name": "b", "route": {"start": [0, 9, 9], "goal": [20, 9, 9]}},
    ]})  # fmt: skip
    told: list[float] = []
    laid = lay_in_space(fleet.members, 1.0, ThisProcess(), told.append)
    assert list(laid.plans) == ["a", "b"]
    assert told == sorted(told)
    assert told[-1] <= 1.0
