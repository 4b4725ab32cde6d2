from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.fleet.laying.lay_among_rests import MOST_MET
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


def pen(x: float) -> dict[str, Any]:
    """A closed fence round a place."""
    ring = [(x - 10, -10), (x + 10, -10), (x + 10, 10), (x - 10, 10)]
    hole = [(x - 8, -8), (x + 8, -8), (x + 8, 8), (x - 8, 8)]
    return {"name": "pen", "polygon": ring, "holes": [hole]}


def corridor(length: float) -> list[dict[str, Any]]:
    """The walls of a corridor 3 m wide, in which two of these robots can't pass."""
    walls = [(1.5, 2.5), (-2.5, -1.5)]
    return [{"polygon": [[-5, a], [length, a], [length, b], [-5, b]]} for a, b in walls]


def flanks() -> list[dict[str, Any]]:
    """What closes the room beside the corridor."""
    return [{"polygon": [[-5, a], [-4, a], [-4, b], [-5, b]]} for a, b in [(2.5, 12), (-12, -2.5)]]


def test_nobody_is_laid_through_a_robot_that_has_no_path() -> None:
    asked = {"bounds": [-5, -12, 250, 12], "known": [*corridor(180), *flanks(), pen(200)]}
    stuck = robot("stuck", (20, 0), (200, 0), world=asked)
    a, b = robot("a", (0, 0), (40, 0), world=asked), robot("b", (5, 0), (10, 0), world=asked)
    found = laid(stuck, a, b)
    assert set(found.plans) == {"b"}
    first, second = found.not_served
    assert (first.name, first.outcome, second.name, second.outcome) == (
        "stuck", "refused", "a", "refused",
    )  # fmt: skip
    assert second.obstacles == ("stuck",)
    assert "'stuck'" in second.reason
    assert "'stuck'" in second.remedy


def test_who_stands_for_ever_where_another_has_to_get_to_is_named_with_the_distance() -> None:
    world = {"known": [pen(100)]}
    stuck = robot("stuck", (20, 0.5), (100, 0), world=world)
    found = laid(stuck, robot("a", (0, 0), (20, 0), (40, 0), world=world))
    assert not found.plans
    _, second = found.not_served
    assert second.outcome == "refused"
    assert "1.50 m too near to route.via[0]" in second.reason


def test_who_is_hemmed_in_by_one_without_a_path_has_none_either() -> None:
    asked = {"bounds": [-5, -12, 250, 12], "known": [*corridor(180), *flanks(), pen(200)]}
    stuck = robot("stuck", (20, 0), (200, 0), world=asked)
    inner, outer = (
        robot(name, (x, 0), (x + 25, 0), world=asked) for name, x in (("c", 5), ("d", 1))
    )
    found = laid(inner, stuck, outer)
    assert not found.plans
    assert {one.name for one in found.not_served} == {"stuck", "c", "d"}


@settings(max_examples=15, deadline=None)
@given(st.floats(2.0, 2.3), st.booleans())
def test_tight_resting_places_are_kept_from_as_far_as_via_points_allow(
    apart: float, on_the_left: bool
) -> None:
    side = apart if on_the_left else -apart
    found = laid(robot("a", (0, 0), (30, 0)), robot("b", (0, side), (-30, side)))
    assert not found.passed
    assert least_distance(found, "a", (0, side)) >= APART - 1e-6
    assert least_distance(found, "b", (0, 0)) >= APART - 1e-6


@pytest.mark.parametrize("spare", [0.06, 0.1009, 0.15])
def test_bodies_that_are_parked_in_a_row_get_past_each_other(spare: float) -> None:
    body = {"footprint": [[-0.1, -0.3], [0.6, -0.3], [0.6, 0.3], [-0.1, 0.3]]}
    apart = 2.0 * math.hypot(0.6, 0.3) + 1.0
    row = [(-k * (apart + spare), 0.0) for k in range(4)]
    found = laid(
        *(robot(f"r{k}", (x, 0.0), (20.0 - x, 40.0), robot=body) for k, (x, _) in enumerate(row))
    )
    assert not found.passed
    for k in range(4):
        for place in row[:k] + row[k + 1 :]:
            assert least_distance(found, f"r{k}", place) >= apart - 1e-6


def test_a_path_that_passes_very_many_in_a_row_is_laid_past_them_all() -> None:
    row = [(5.0 + 3.0 * k, 0.5) for k in range(MOST_MET + 2)]
    parked = [robot(f"p{k}", (x, y), (x, -30.0), rest="leave") for k, (x, y) in enumerate(row)]
    found = laid(robot("a", (0, 0), (row[-1][0] + 5.0, 0)), *parked)
    assert "a" not in found.passed
    assert min(least_distance(found, "a", place) for place in row) >= APART - 1e-6
