"""A fleet is prepared from what was found of it before, and planned to the same bytes."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np
import pytest

from viaspline.fleet.crossing_paths import CrossingPaths, crossing_paths
from viaspline.fleet.plan_fleet import plan_fleet
from viaspline.mission.fleet.fleet import Fleet

DATA: dict[str, Any] = {
    "separation_m": 1.0,
    "fleet": [
        {"name": "a", "route": {"start": [0, 0], "goal": [40, 0]}},
        {"name": "b", "route": {"start": [20, -20], "via": [[20, 5]], "goal": [20, 20]}},
        {"name": "c", "route": {"start": [0, -10], "goal": [40, -8]}, "rest": "leave"},
    ],
}


def moved(change: str) -> Fleet:
    data = copy.deepcopy(DATA)
    if change == "a via point":
        data["fleet"][1]["route"]["via"] = [[24, 3]]
    if change == "a goal":
        data["fleet"][1]["route"]["goal"] = [31, 0.5]
    if change == "the separation":
        data["separation_m"] = 2.0
    if change == "a robot less":
        del data["fleet"][2]
    if change == "the order":
        data["fleet"].reverse()
    if change == "a priority":
        data["fleet"][1]["priority"] = 3
    return Fleet.model_validate(data)


@pytest.fixture(scope="module")
def before() -> CrossingPaths:
    return crossing_paths(Fleet.model_validate(DATA))


@pytest.mark.parametrize(
    "change",
    ["a via point", "a goal", "the separation", "a robot less", "the order", "a priority"],
)
def test_the_plan_is_the_same_as_without_it(before: CrossingPaths, change: str) -> None:
    fleet = moved(change)
    found = plan_fleet(fleet, paths=crossing_paths(fleet, before=before))
    anew = plan_fleet(fleet)
    assert found.certificate == anew.certificate
    assert found.certificate.holds
    assert found.precedences == anew.precedences
    assert found.not_served == anew.not_served
    for key, values in anew.laws.packed._asdict().items():
        assert np.array_equal(getattr(found.laws.packed, key), values), key


def test_what_has_not_changed_is_the_very_same(before: CrossingPaths) -> None:
    found = crossing_paths(moved("a priority"), before=before)
    assert found.courses is before.courses
    assert found.crossings is before.crossings
