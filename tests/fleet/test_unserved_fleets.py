"""Who isn't served is told who is in the way, where, whether that is proven, and what helps."""

from __future__ import annotations

import copy
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import viaspline as vs
from viaspline.fleet.crossing_paths import crossing_paths
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.fleet_ways import FleetWays
from viaspline.fleet.plan_fleet import plan_by_priority, plan_fleet
from viaspline.fleet.timed_fleet import TimedFleet
from viaspline.fleet.unserved.explain_unserved import explain_unserved
from viaspline.mission.fleet.fleet import Fleet

CART = {"radius_m": 0.4, "clearance_m": 0.1, "max_speed_mps": 1.5}
AISLE = {"bounds": [0, 0, 30, 1.6]}
APART = 1.1  # centre to centre


def robot(name: str, start: Any, goal: Any, **more: Any) -> dict[str, Any]:
    return {"name": name, "route": {"start": start, "goal": goal}, **more}


def asked(*robots: dict[str, Any], **more: Any) -> dict[str, Any]:
    return {"separation_m": 0.3, "robots": {"cart": CART}, "fleet": list(robots), **more}


def planned(*robots: dict[str, Any], **more: Any) -> FleetPlan:
    return plan_fleet(Fleet.model_validate(asked(*robots, **more)))


def in_aisle(*ends: tuple[float, float], **more: Any) -> FleetPlan:
    robots = [robot(f"r{k}", [a, 0.8], [b, 0.8]) for k, (a, b) in enumerate(ends)]
    return planned(*robots, world=AISLE, **more)


def test_two_that_cannot_change_ends_are_refused_with_the_stretch() -> None:
    plan = in_aisle((2, 28), (28, 2))
    assert not plan.plans
    for one, other in zip(plan.not_served, reversed(plan.not_served), strict=True):
        assert one.outcome == "refused"
        assert one.obstacles == (other.name,)
        assert "26.0 m" in one.reason
        assert "whatever they do" in one.reason
        assert one.remedy in ("let 'r0' leave (rest: leave)", "let 'r1' leave (rest: leave)")
    start, goal = [2, 0.8], [28, 0.8]
    for rests in (("leave", "stay"), ("stay", "leave")):  # who stays backs off behind its start
        one, other = (
            robot("r0", start, goal, rest=rests[0]),
            robot("r1", goal, start, rest=rests[1]),
        )
        assert planned(one, other, world=AISLE).served


def test_what_is_tried_for_those_that_are_not_served_is_told_as_it_goes_on() -> None:
    told: list[tuple[str, float]] = []
    ends = ((2, 26), (28, 4), (4, 24))
    robots = [robot(f"r{k}", [a, 0.8], [b, 0.8]) for k, (a, b) in enumerate(ends)]
    bay = {"bounds": [0, 0, 30, 3], "known": [
        {"polygon": [[0, 1.6], [14, 1.6], [14, 3], [0, 3]]},
        {"polygon": [[15.2, 1.6], [30, 1.6], [30, 3], [15.2, 3]]},
    ]}  # fmt: skip
    fleet = Fleet.model_validate(asked(*robots, world=bay))
    plan_fleet(fleet, progress=lambda stage, share: told.append((stage, share)))
    stages = list(dict.fromkeys(stage for stage, _ in told))
    assert stages[-1] == "proving"
    for stage in ("laying paths past others", "looking for what would help"):
        shares = [share for one, share in told if one == stage]
        assert len(shares) > len(robots)
        assert shares == sorted(shares)
        assert 0.0 <= shares[0] < shares[-1] <= 1.0


def test_who_rests_in_an_aisle_is_to_leave_and_then_all_are_served() -> None:
    plan = in_aisle((2, 28), (10, 20))
    assert set(plan.plans) == {"r1"}
    (missing,) = plan.not_served
    assert missing.outcome == "refused"
    assert "'r1' rests at its goal where 'r0' has to pass" in missing.reason
    assert missing.remedy == "let 'r1' leave (rest: leave)"
    again = planned(
        robot("r0", [2, 0.8], [28, 0.8]), robot("r1", [10, 0.8], [20, 0.8], rest="leave"),
        world=AISLE,
    )  # fmt: skip
    assert again.served


def followed(data: dict[str, Any], remedy: str) -> dict[str, Any] | None:
    """What is asked for if a remedy is followed; None: it says that it wasn't tried, or is none."""
    if "wasn't tried" in remedy or "isn't served without" in remedy:
        return None
    then = copy.deepcopy(data)
    members = {one["name"]: one for one in then["fleet"]}
    names, numbers = re.findall(r"'(\w+)'", remedy), re.findall(r"-?\d+\.?\d*(?!\w*')", remedy)
    if remedy.startswith("leave "):
        then["fleet"] = [one for one in then["fleet"] if one["name"] not in names]
    elif remedy.startswith("give "):
        members[names[0]]["priority"] = float(numbers[-1])
    elif "depart at" in remedy:
        members[names[0]]["route"]["depart_s"] = float(numbers[-1])
    elif remedy.endswith("leave (rest: leave)"):
        members[names[0]]["rest"] = "leave"
    elif remedy.startswith("move the "):
        members[names[0]]["route"][remedy.split()[2]] = [float(one) for one in numbers[-2:]]
    else:
        assert remedy.startswith("ask for a separation of ")
        then["separation_m"] = float(numbers[-1])
    return then


def follow(data: dict[str, Any]) -> int:
    """Follow what helps each robot that isn't served; how many of these are served by that."""
    plan, helped = plan_fleet(Fleet.model_validate(data)), 0
    for missing in plan.not_served:
        then = followed(data, missing.remedy)
        if then is not None:
            again = plan_fleet(Fleet.model_validate(then))
            asked_then = {one["name"] for one in then["fleet"]}
            assert {*plan.plans, missing.name} & asked_then <= set(again.plans), missing.remedy
            assert missing.name in asked_then
            helped += 1
    return helped


def test_of_robots_in_a_full_aisle_those_are_named_without_which_all_others_are_served() -> None:
    """No single change helps: two go up, two go down, and it was said to leave one out, untried."""
    ends = ((2, 24), (26, 4), (6, 28), (22, 1))
    robots = [robot(f"r{k}", [a, 0.8], [b, 0.8]) for k, (a, b) in enumerate(ends)]
    fleet = Fleet.model_validate(asked(*robots, world=AISLE))
    paths = crossing_paths(fleet)
    timed = TimedFleet.by_priority(FleetWays.of(fleet, paths)).past_standing_ones()
    found = explain_unserved(fleet, paths, timed, budget=12.0)
    assert {one.name: one.remedy for one in found} == {
        "r0": "leave 'r1' and 'r3' out", "r1": "leave 'r0' and 'r2' out",
        "r2": "leave 'r1' and 'r3' out", "r3": "leave 'r0' and 'r2' out",
    }  # fmt: skip
    assert planned(*robots[::2], world=AISLE).served
    assert planned(*robots[1::2], world=AISLE).served


@pytest.mark.slow
@given(seed=st.integers(0, 10_000))
@settings(max_examples=6, deadline=None)
def test_what_is_said_to_help_helps_and_nobody_is_lost_by_it(seed: int) -> None:
    """Three to five robots in an aisle with a pocket and a room at its end, at drawn places."""
    random = np.random.default_rng(seed)
    count = int(random.integers(3, 6))
    starts, goals = (random.permutation(np.arange(a, 28.5, 1.5))[:count] for a in (2.0, 2.75))
    robots = [
        robot(f"r{k}", [a, 0.8], [b, 0.8], rest=str(random.choice(["stay", "leave"])))
        for k, (a, b) in enumerate(zip(starts.tolist(), goals.tolist(), strict=True))
    ]
    follow(asked(*robots, world=side_step(2.0) | {"bounds": [0, 0, 30, 8]}))


def test_of_what_is_told_while_a_route_is_dragged_nothing_was_tried() -> None:
    fleet = Fleet.model_validate(
        asked(robot("a", [2, 0.8], [28, 0.8]), robot("b", [28, 0.8], [2, 0.8]), world=AISLE)
    )
    plan = plan_by_priority(fleet, crossing_paths(fleet))
    assert {one.outcome for one in plan.not_served} == {"gave up"}
    assert all("wasn't tried" in one.remedy for one in plan.not_served)


def side_step(depth: float) -> dict[str, Any]:
    """An aisle with a pocket of some depth in its middle, a metre and a half wide."""
    low, high = 7.0, 8.5
    walls = [(0.0, low, 1.6), (high, 15.5, 1.6), (low, high, 1.6 + depth)]
    known = [{"polygon": [[a, h], [b, h], [b, 9], [a, 9]]} for a, b, h in walls]
    return {"bounds": [0, 0, 15.5, 8], "known": known}


def could_pass(depth: float) -> bool:
    """An oracle of its own: is one robot as far up the pocket as it gets clear of the aisle?"""
    lowest, highest = 0.5, 1.6 + depth - 0.5
    return highest - lowest >= APART


@pytest.mark.parametrize(
    ("depth", "has_third"),
    [
        (0.0, False),
        pytest.param(0.3, False, marks=pytest.mark.slow),
        pytest.param(2.5, True, marks=pytest.mark.slow),
    ],
)
def test_refused_are_only_those_that_have_no_way(depth: float, has_third: bool) -> None:
    robots = [robot("a", [1, 0.8], [14, 0.8]), robot("b", [14, 0.8], [1, 0.8])]
    robots += [robot("c", [3, 0.8], [5, 0.8], rest="leave")] if has_third else []
    plan = planned(*robots, world=side_step(depth))
    refused = {one.name for one in plan.not_served if one.outcome == "refused"}
    assert not (refused and could_pass(depth))
    if not could_pass(depth):
        assert refused <= {"a", "b"}
        assert len({"a", "b"} & set(plan.plans)) < 2


def named(remedy: str, data: dict[str, Any]) -> dict[str, Any]:
    """The fleet that a remedy asks for."""
    if found := re.fullmatch(r"leave '(\w+)' out", remedy):
        data["fleet"] = [one for one in data["fleet"] if one["name"] != found[1]]
    elif found := re.fullmatch(r"let '(\w+)' leave \(rest: leave\)", remedy):
        next(one for one in data["fleet"] if one["name"] == found[1])["rest"] = "leave"
    elif found := re.fullmatch(r"move the (\w+) of '(\w+)' to \((.*), (.*)\)", remedy):
        one = next(one for one in data["fleet"] if one["name"] == found[2])
        one["route"][found[1]] = [float(found[3]), float(found[4])]
    elif found := re.fullmatch(r"let '(\w+)' depart at (.*) s \(depart_s\)", remedy):
        next(one for one in data["fleet"] if one["name"] == found[1])["depart_s"] = float(found[2])
    elif found := re.fullmatch(r"give '(\w+)' priority (.*)", remedy):
        next(one for one in data["fleet"] if one["name"] == found[1])["priority"] = float(found[2])
    elif found := re.fullmatch(r"ask for a separation of (.*) m \(separation_m\)", remedy):
        data["separation_m"] = float(found[1])
    else:
        pytest.fail(remedy)
    return data


@pytest.mark.parametrize("seed", [0, 3, pytest.param(1, marks=pytest.mark.slow)])
def test_what_is_named_as_a_remedy_helps(seed: int) -> None:
    random = np.random.default_rng(seed)
    starts = random.permutation([2.0, 7.0, 12.0, 17.0, 22.0, 27.0])[:3]
    goals = random.permutation([3.0, 8.0, 13.0, 18.0, 23.0, 28.0])[:3]
    rests = random.choice(["stay", "leave"], 3)
    robots = [
        robot(f"r{k}", [float(a), 0.8], [float(b), 0.8], rest=str(rest))
        for k, (a, b, rest) in enumerate(zip(starts, goals, rests, strict=True))
    ]
    plan = planned(*robots, world=AISLE)
    assert plan.certificate.holds
    for one in plan.not_served:
        if "isn't served without" in one.remedy:
            continue
        then = plan_fleet(Fleet.model_validate(named(one.remedy, asked(*robots, world=AISLE))))
        assert one.name in then.plans


def line_is_possible(starts: Any, goals: Any) -> bool:
    """On a line nobody passes anybody: who stays ends in the order in which all began."""
    return list(np.argsort(starts)) == list(np.argsort(goals))


@pytest.mark.parametrize(
    ("starts", "goals"),
    [
        ([2.0, 7.0, 12.0, 17.0], [8.0, 13.0, 18.0, 27.0]),
        ([17.0, 2.0, 12.0, 7.0], [20.0, 5.0, 17.0, 8.0]),
        ([2.0, 7.0, 12.0], [8.0, 3.0, 13.0]),
        pytest.param([2.0, 7.0, 12.0], [13.0, 8.0, 3.0], marks=pytest.mark.slow),
    ],
)
def test_on_a_line_all_that_stay_are_served_just_where_their_order_stays(
    starts: list[float], goals: list[float]
) -> None:
    plan = in_aisle(*zip(starts, goals, strict=True))
    if line_is_possible(starts, goals):
        assert plan.served
    else:
        assert plan.not_served
        pairs = {
            (one.name, one.obstacles[0]) for one in plan.not_served if one.outcome == "refused"
        }
        for mine, other in pairs:
            i, j = int(mine[1:]), int(other[1:])
            assert (starts[i] < starts[j]) != (goals[i] < goals[j])


@pytest.mark.parametrize("away", [1.2, 1.5, 4.0])
def test_how_far_others_stay_from_one_without_a_path_is_proven(
    away: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        "viaspline.report.files.fleet_results.fleet_picture", lambda plan, name: b""
    )
    ring = [[8, away - 0.6], [12, away - 0.6], [12, away + 4], [8, away + 4]]
    walls = [
        {"capsule": {"from": one, "to": other, "radius": 0.02}}
        for one, other in zip(ring, [*ring[1:], ring[0]], strict=True)
    ]
    shut = robot("shut in", [10, away], [10, 30])
    south = {"bounds": [-2, -10, 22, 40]}
    post = {"circle": {"center": [10, 34], "radius": 2}}
    plan = planned(
        robot("a", [0, 0], [20, 0]), shut, robot("b", [0, -9], [20, -9]),
        world={**south, "known": [*walls, post]},
    )  # fmt: skip
    assert set(plan.plans) == {"a", "b"}
    assert plan.certificate.pair is not None
    assert set(plan.certificate.pair) == {"a", "shut in"}
    times = np.arange(0.0, plan.plans["a"].trajectory.end_time, 0.01)
    path = plan.plans["a"].path
    places = path.at_distance(plan.plans["a"].trajectory.distance_at(times))
    nearest = float(np.hypot(*(places - np.array([10, away])).T).min()) - 0.8
    assert plan.certificate.separation <= nearest + 1e-9
    assert plan.certificate.separation == pytest.approx(nearest, abs=0.005)
    plan.save(tmp_path)
    assert vs.load_fleet_plan(tmp_path) == plan
