"""Headings that a path of lines can't keep are named, not dropped."""

from __future__ import annotations

import warnings
from typing import Any

import pytest

from viaspline.errors import MissionWarning
from viaspline.mission.model import Mission

ROUTE = {
    "start": {"at": [0, 0], "heading_deg": 70},
    "via": [[5, 5]],
    "goal": {"at": [9, 0], "heading_deg": 0},
}


def warned(**more: Any) -> list[str]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        Mission.model_validate({"route": ROUTE, **more})
    assert all(warning.category is MissionWarning for warning in caught)
    return [str(warning.message).split()[0] for warning in caught]


START, GOAL = "route.start.heading_deg", "route.goal.heading_deg"


@pytest.mark.parametrize(
    ("spline", "lost"),
    [
        ({"tension": 1}, [START, GOAL]),
        ({"slack": 0}, [START, GOAL]),
        ({"tension": [1, 0.5]}, [START]),
        ({"slack": [0.5, 0]}, [GOAL]),
        ({"tension": 0.99}, []),
        ({"tension": "auto"}, []),
        ({}, []),
    ],
)
def test_a_heading_that_lines_cannot_keep_draws_a_warning(
    spline: dict[str, Any], lost: list[str]
) -> None:
    assert warned(spline=spline) == lost


def test_a_path_of_turns_keeps_its_headings_whatever_the_tension() -> None:
    assert warned(spline={"tension": 1}, robot={"min_turn_radius_m": 1}) == []
