from __future__ import annotations

import io

import pytest
from rich.console import Console, RenderableType

from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan
from viaspline.report.screen import plan_tables, run_tables
from viaspline.report.summary import spline_words, summary, tension
from viaspline.robot.run import Run
from viaspline.robot.simulator import simulate

TENT = {"name": "tent [red]", "circle": {"center": [60, 0], "radius": 5}}


def _text(tables: RenderableType) -> str:
    stream = io.StringIO()
    Console(file=stream, width=160, markup=False).print(tables)
    return stream.getvalue()


def test_the_plan_is_told_in_figures(planned: Plan) -> None:
    text = _text(plan_tables(planned, "yard"))
    words = ("length", "duration", "clearance, proven", "tightest place", "largest curvature")
    assert all(word in text for word in (*words, "tank $1", "left", "right", "taken", "pump 5 s"))


def test_the_run_is_told_in_figures(driven: Run) -> None:
    text = _text(run_tables(driven, "yard"))
    assert all(word in text for word in ("yes", "4 of 4", "crate", "reflex"))


def test_a_run_that_failed_says_so_with_names_as_they_are() -> None:
    mission = Mission.model_validate(
        {
            "world": {"unseen": [TENT]},
            "robot": {"sensor": {"range_m": 15}},
            "route": {"start": [0, 0], "goal": {"at": [60, 0], "name": "camp"}},
        }
    )
    text = _text(run_tables(simulate(mission), "late"))
    assert "NO: " in text
    assert "tent [red]" in text


def test_an_empty_world_has_nothing_to_keep_clear_of() -> None:
    mission = Mission.model_validate({"route": {"start": [0, 0], "goal": [9, 0]}})
    text = _text(plan_tables(plan(mission), "x"))
    assert "unlimited" in text
    assert "tightest" not in text


@pytest.mark.parametrize(
    ("spline", "value"),
    [
        ({}, 0.0),
        ({"tension": 0.25}, 0.25),
        ({"slack": 0.5}, 0.0),
        ({"slack": [0.5, 0.0]}, [0.0, 1.0]),
    ],
)
def test_both_names_of_the_tension_are_understood(
    spline: dict[str, object], value: float | list[float]
) -> None:
    route = {"start": [0, 0], "via": [[5, 5]], "goal": [9, 0]}
    assert tension(Mission.model_validate({"route": route, "spline": spline})) == value


def test_a_mission_is_summed_up_in_four_lines(mission: Mission) -> None:
    lines = dict(summary(mission))
    assert list(lines) == ["route", "world", "robot", "spline"]
    assert "4 points" in lines["route"]
    assert "1 station with stops of 5 s" in lines["route"]
    assert "2 known obstacles (1 circle and 1 polygon), 1 unseen obstacle" in lines["world"]
    assert "tension 0 (slack 0.5)" in spline_words(mission)
