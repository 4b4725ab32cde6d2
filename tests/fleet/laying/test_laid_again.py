"""A fleet of which little has changed is laid again: nothing is laid that is known already."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
import pytest

from viaspline.fleet.laying.kept_paths import KeptPaths
from viaspline.fleet.laying.lay_paths import LaidPaths, lay_paths
from viaspline.mission.fleet.fleet import Fleet

DATA: dict[str, Any] = {
    "world": {"known": [{"circle": {"center": [20, 3], "radius": 2}}]},
    "separation_m": 1.0,
    "fleet": [
        {"name": "a", "route": {"start": [0, 0], "via": [[12, 4]], "goal": [40, 0]}},
        {"name": "b", "route": {"start": [25, -20], "via": [[26, 2]], "goal": [24, 20]}},
        {"name": "c", "route": {"start": [30, 0.3], "goal": [30, 25]}},
    ],
}


def with_route(robot: int, key: str, place: Any) -> Fleet:
    data = copy.deepcopy(DATA)
    data["fleet"][robot]["route"][key] = place
    return Fleet.model_validate(data)


@pytest.fixture(scope="module")
def first() -> LaidPaths:
    return lay_paths(Fleet.model_validate(DATA))


def kept(laid: LaidPaths) -> KeptPaths:
    assert laid.kept is not None
    return laid.kept


def assert_as_laid_anew(again: LaidPaths, fleet: Fleet) -> None:
    anew = lay_paths(fleet)
    assert list(again.plans) == list(anew.plans)
    for name, plan in anew.plans.items():
        assert np.array_equal(again.plans[name].path.spans, plan.path.spans)
        assert np.array_equal(again.plans[name].trajectory.times, plan.trajectory.times)
    assert dict(again.passed) == dict(anew.passed)
    assert again.not_served == anew.not_served


def test_only_the_robot_whose_via_point_moves_is_laid_again(first: LaidPaths) -> None:
    fleet = with_route(1, "via", [[27, 2]])
    again = lay_paths(fleet, before=kept(first))
    assert again.plans["a"] is first.plans["a"]
    assert again.plans["c"] is first.plans["c"]
    assert again.plans["b"] is not first.plans["b"]
    assert_as_laid_anew(again, fleet)


@pytest.mark.parametrize("place", [[30, -5], [30, 1.5], [12, 9]])
def test_others_go_round_a_start_where_it_is_now(first: LaidPaths, place: list[float]) -> None:
    fleet = with_route(2, "start", place)
    assert_as_laid_anew(lay_paths(fleet, before=kept(first)), fleet)


def test_a_path_that_comes_out_the_same_is_the_one_that_there_was(first: LaidPaths) -> None:
    again = lay_paths(with_route(2, "goal", [35, 25]), before=kept(first))
    assert again.plans["a"] is first.plans["a"]
    assert again.plans["b"] is first.plans["b"]


def test_another_world_lays_all_of_it_again(first: LaidPaths) -> None:
    data = copy.deepcopy(DATA)
    data["world"]["known"][0]["circle"]["radius"] = 2.5
    fleet = Fleet.model_validate(data)
    again = lay_paths(fleet, before=kept(first))
    assert again.plans["a"] is not first.plans["a"]
    assert_as_laid_anew(again, fleet)


def test_robots_come_and_go(first: LaidPaths) -> None:
    data = copy.deepcopy(DATA)
    data["fleet"][0] = {"name": "d", "route": {"start": [-5, 10], "goal": [40, 10]}}
    fleet = Fleet.model_validate(data)
    again = lay_paths(fleet, before=kept(first))
    assert list(again.plans) == ["d", "b", "c"]
    assert_as_laid_anew(again, fleet)


def test_a_robot_without_a_path_stays_without_until_its_route_changes(first: LaidPaths) -> None:
    data = copy.deepcopy(DATA)
    data["world"]["known"].append(
        {"polygon": [[-9, -9], [-9, 9], [-5, 9], [-5, -5], [45, -5], [45, 9], [49, 9], [49, -9]]}
    )
    data["world"]["bounds"] = [-10, -25, 50, 10]
    data["fleet"][1]["route"] = {"start": [25, -20], "goal": [26, 5]}
    data["fleet"][2]["route"] = {"start": [30, 0.3], "goal": [30, 7]}
    fleet = Fleet.model_validate(data)
    again = lay_paths(fleet, before=kept(first))
    assert_as_laid_anew(again, fleet)
    assert lay_paths(fleet, before=kept(again)).not_served == again.not_served
