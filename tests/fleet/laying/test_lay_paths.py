from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.fleet.laying.lay_paths import LaidPaths, lay_paths
from viaspline.mission.fleet.fleet import Fleet, FleetMember
from viaspline.mission.model import Mission

APART = 2.0  # centre to centre: twice a radius of 0.5 m, and 1 m between
TAUT = {"tension": 0.0}  # so that lines and turns aren't weighed as well
Place = tuple[float, float]


def robot(name: str, *points: Place, rest: Any = "stay", **more: Any) -> FleetMember:
    start, *via, goal = points
    data = {"robot": {"radius_m": 0.5}, "route": {"start": start, "via": via, "goal": goal}}
    return FleetMember(name, Mission.model_validate(data | more), rest=rest)


def laid(*members: FleetMember) -> LaidPaths:
    return lay_paths(Fleet.of(members, 1.0))


def least_distance(found: LaidPaths, name: str, place: Place) -> float:
    path = found.plans[name].path
    line = path.evaluate(np.linspace(*path.domain, 200 * len(path.spans)))
    return float(np.hypot(*(line - place).T).min())


def spread(places: list[Place]) -> bool:
    return all(math.dist(a, b) > APART + 0.1 for k, a in enumerate(places) for b in places[:k])


coordinate = st.integers(0, 60).map(float)
ends = st.lists(st.tuples(coordinate, coordinate), min_size=6, max_size=12, unique=True)


@settings(max_examples=20, deadline=None)
@given(ends.filter(spread))
def test_no_path_comes_too_near_to_where_another_robot_rests(places: list[Place]) -> None:
    pairs = list(zip(places[::2], places[1::2], strict=False))
    found = laid(*(robot(f"r{k}", *pair, spline=TAUT) for k, pair in enumerate(pairs)))
    assert not found.not_served
    for k in range(len(pairs)):
        passed = {(one.robot, one.at) for one in found.passed.get(f"r{k}", ())}
        for j, pair in enumerate(pairs):
            for place in pair:
                if j != k and (f"r{j}", place) not in passed:
                    assert least_distance(found, f"r{k}", place) >= APART - 1e-6
    assert not found.passed


def test_a_path_that_meets_nothing_is_the_one_of_the_robot_alone() -> None:
    a = robot("a", (0, 0), (30, 20), (60, 0))
    alone = laid(a).plans["a"]
    among = laid(a, robot("b", (0, 30), (60, 40))).plans["a"]
    assert among.path.spans.tobytes() == alone.path.spans.tobytes()


def test_via_points_are_run_through_in_order_where_a_path_steps_aside() -> None:
    a = robot("a", (0, 0), (20, 0), (40, 5), (60, 0))
    path = laid(a, robot("b", (10, 0.5), (10, 30)), robot("c", (42, 4), (50, 30))).plans["a"].path
    own = [via for via in path.vias if via.kind == "user"]
    assert [via.index for via in own] == [0, 1, 2, 3]
    for via, place in zip(own, [(0, 0), (20, 0), (40, 5), (60, 0)], strict=True):
        assert path.evaluate(via.u) == pytest.approx(place, abs=1e-12)
    assert any(via.kind == "detour" for via in path.vias)


def test_the_distance_is_kept_whatever_clearance_the_robot_keeps_from_obstacles() -> None:
    for clearance in (0.0, 0.5, 4.0):
        body = {"radius_m": 0.5, "clearance_m": clearance, "min_turn_radius_m": 3.0}
        found = laid(robot("a", (0, 0), (60, 0), robot=body), robot("b", (30, 0.5), (30, 40)))
        assert APART <= least_distance(found, "a", (30, 0.5)) < APART + 0.2 + clearance


def test_one_that_leaves_does_not_rest_at_its_goal() -> None:
    a, b = robot("a", (0, 0), (60, 0)), robot("b", (30, 40), (30, 0.5), rest="leave")
    assert laid(a, b).plans["a"].path.length == pytest.approx(60.0)


def test_a_start_on_the_goal_of_another_is_passed_and_named() -> None:
    found = laid(robot("a", (0, 0), (30, 0)), robot("b", (30, 0.5), (30, 40)))
    assert set(found.plans) == {"a", "b"}
    assert [(one.robot, one.kind) for one in found.passed["a"]] == [("b", "start")]
    assert [(one.robot, one.kind) for one in found.passed["b"]] == [("a", "goal")]


def test_who_rests_in_a_corridor_is_passed_and_named() -> None:
    walls = [{"polygon": [[-5, y], [65, y], [65, y + 1], [-5, y + 1]]} for y in (2.0, -3.0)]
    world = {"bounds": [-5, -3, 65, 3], "known": walls}
    a = robot("a", (0, 0), (60, 0), world=world)
    found = laid(a, robot("b", (30, 0), (62.5, 0), world=world))
    assert [(one.robot, one.kind) for one in found.passed["a"]] == [("b", "start")]
    assert found.plans["a"].certificate.holds


def test_who_has_no_path_is_named_with_the_reason_and_stands_at_its_start() -> None:
    ring = [(50, -10), (70, -10), (70, 10), (50, 10)]
    hole = [(52, -8), (68, -8), (68, 8), (52, 8)]
    world = {"known": [{"name": "keep", "polygon": ring, "holes": [hole]}]}
    a, b = robot("a", (20, 0), (60, 0), world=world), robot("b", (0, 0), (40, 0), world=world)
    found = laid(a, b)
    (refused,) = found.not_served
    assert (refused.name, refused.outcome) == ("a", "refused")
    assert "keep" in refused.reason
    assert refused.remedy
    assert least_distance(found, "b", (20, 0)) >= APART


def test_a_fleet_of_one_is_laid() -> None:
    assert set(laid(robot("a", (0, 0), (9, 0))).plans) == {"a"}


def test_progress_counts_paths() -> None:
    seen: list[tuple[int, int]] = []
    members = (robot("a", (0, 0), (9, 0)), robot("b", (0, 9), (9, 9)))
    lay_paths(Fleet.of(members, 1.0), progress=lambda done, all_: seen.append((done, all_)))
    assert seen == [(1, 4), (2, 4), (3, 4), (4, 4)]
