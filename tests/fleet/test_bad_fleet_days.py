"""What fleets ask for on bad days, each with the outcome that it has; seen every 10 ms."""

from __future__ import annotations

from itertools import combinations
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viaspline as vs
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.plan_fleet import plan_fleet
from viaspline.kernels.arrays import Floats
from viaspline.mission.fleet.fleet import Fleet
from viaspline.planner import Plan

CART = {"radius_m": 0.4, "clearance_m": 0.1, "max_speed_mps": 1.5}
APART = 1.3  # two radii and half a metre
EXAMPLES = Path(__file__).parents[2] / "examples"


def robot(name: str, *points: Any, **more: Any) -> dict[str, Any]:
    start, *via, goal = points
    return {"name": name, "route": {"start": start, "via": via, "goal": goal}, **more}


def planned(*robots: dict[str, Any], **more: Any) -> FleetPlan:
    return plan_fleet(
        Fleet.model_validate({"robots": {"cart": CART}, "fleet": list(robots), **more})
    )


def places(plan: Plan, times: Floats) -> Floats:
    return np.asarray(plan.path.at_distance(plan.trajectory.distance_at(times)))


def least_distance(plan: FleetPlan) -> float:
    """Of any two robots, as long as the last one drives."""
    plans = list(plan.plans.values())
    times = np.arange(0.0, max(one.trajectory.end_time for one in plans), 0.01)
    return min(
        float(np.hypot(*(places(a, times) - places(b, times)).T).min())
        for a, b in combinations(plans, 2)
    )


STATION = {"at": [10, 0], "dwell_s": 20}


@pytest.mark.parametrize(
    "robots",
    [
        (robot("a", [0, 0], [9, 0]), robot("b", [9, 0], [9, 9])),
        (robot("a", [0, 0], STATION, [20, 0]), robot("b", [10, -10], [10, 10])),
        (robot("a", [0, 0], STATION, [20, 0]), robot("b", [10, 0.3], [10, 10])),
        (robot("a", [0, 0], STATION, [20, 0]), robot("b", [10, 10], [10, 0.3])),
        (
            robot("a", [0, 0], [9, 0]), robot("b", [9, 0], [9, 9]), robot("c", [9, 9], [0, 9]),
            robot("d", [0, 9], [0, 0]),
        ),
        (robot("a", [0, 0], [9, 0]), robot("b", [9, 0], [0, 0])),
    ],
    ids=[
        "a start on another's goal", "a station in another's way", "a station on another's start",
        "a station on another's goal", "a ring of robots that each want the next one's place",
        "two that swap places",
    ],
)  # fmt: skip
def test_all_are_served_and_apart(robots: tuple[dict[str, Any], ...]) -> None:
    plan = planned(*robots)
    assert plan.served
    assert least_distance(plan) >= APART - 1e-6


@pytest.mark.slow
def test_a_body_too_long_for_the_bay_is_not_served_and_told_so() -> None:
    walls = [(0.0, 7.0), (8.05, 16.0)]
    known = [{"polygon": [[a, 1.6], [b, 1.6], [b, 6], [a, 6]]} for a, b in walls]
    long = [[-1.2, -0.3], [1.2, -0.3], [1.2, 0.3], [-1.2, 0.3]]
    plan = planned(
        robot("a", [2, 0.8], [14, 0.8]), robot("b", [14, 0.8], [2, 0.8]),
        robots={"cart": {"footprint": long, "clearance_m": 0.05, "max_speed_mps": 1.5}},
        world={"bounds": [0, 0, 16, 6], "known": known}, separation_m=0.3,
    )  # fmt: skip
    assert not plan.plans
    for one in plan.not_served:
        assert one.outcome == "gave up"
        assert "get past each other" in one.reason
        assert "leave '" in one.remedy


def test_the_example_finds_the_bay_without_being_told_of_it() -> None:
    fleet = vs.load(EXAMPLES / "corridor-bay.yaml")
    assert isinstance(fleet, Fleet)
    assert not any(one.mission.route.via for one in fleet.members)
    plan = plan_fleet(fleet)
    assert plan.served
    assert least_distance(plan) >= 1.1 - 1e-6
    tops = [places(one, one.trajectory.times)[:, 1].max() for one in plan.plans.values()]
    assert max(tops) > 2.0


def test_sixteen_in_eight_corridors_are_led_through_their_bays() -> None:
    known, robots = [], []
    for k in range(8):
        y = 10.0 * k
        for x0, x1, low in ((0, 9 + k, 2), (15 + k, 40, 2), (0, 40, 6)):
            high = 10 if low == 6 else 6
            known.append(
                {"polygon": [[x0, y + low], [x1, y + low], [x1, y + high], [x0, y + high]]}
            )
        ends = [2, y + 1], [38, y + 1]
        robots += [robot(f"e{k}", *ends), robot(f"w{k}", *ends[::-1])]
    plan = planned(*robots, world={"bounds": [0, 0, 40, 80], "known": known}, separation_m=0.3)
    assert plan.served
    assert least_distance(plan) >= 1.1 - 1e-6
