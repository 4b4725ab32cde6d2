from __future__ import annotations

import io

import numpy as np
import pytest
from rich.console import Console, RenderableType

from viaspline.curve.certificate import PROOF_SLACK_M
from viaspline.maps.grid import Grid
from viaspline.mission.model import Mission
from viaspline.planner import Plan, plan
from viaspline.planning.problem.ledger import Candidate, LedgerEntry
from viaspline.report.summary import spline_words, summary, tension
from viaspline.report.terminal.plan_tables import ledger_table, plan_tables
from viaspline.report.terminal.run_tables import run_tables
from viaspline.report.units import JUST_TOUCHING_M, down
from viaspline.robot.run import Run
from viaspline.robot.simulator import simulate

TENT = {"name": "tent [red]", "circle": {"center": [60, 0], "radius": 5}}


def _text(tables: RenderableType) -> str:
    stream = io.StringIO()
    Console(file=stream, width=160, markup=False).print(tables)
    return stream.getvalue()


def test_what_just_touches_is_told_as_what_was_asked() -> None:
    assert JUST_TOUCHING_M == PROOF_SLACK_M
    assert (down(-0.3e-6), down(0.4999995), down(0.4999985)) == ("0.000 m", "0.500 m", "0.499 m")


def test_the_plan_is_told_in_figures(planned: Plan) -> None:
    text = _text(plan_tables(planned, "yard"))
    words = ("length", "duration", "clearance, proven", "tightest place", "largest curvature")
    assert all(word in text for word in (*words, "tank $1", "left", "right", "taken", "pump 5 s"))


def test_the_run_is_told_in_figures(driven: Run) -> None:
    text = _text(run_tables(driven, "yard"))
    assert all(word in text for word in ("yes", "4 of 4", "crate", "reflex"))
    assert "reflex: under way, only the blocked spans are laid anew" in text
    assert "from_rest: " not in text


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
        ({}, None),
        ({"tension": 0.25}, 0.25),
        ({"slack": 0.5}, 0.0),
        ({"slack": [0.5, 0.0]}, [0.0, 1.0]),
    ],
)
def test_both_names_of_the_tension_are_understood(
    spline: dict[str, object], value: float | list[float] | None
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
    assert "as none is stated" in lines["spline"]


GRID = Grid(np.eye(20, 30, 4, dtype=bool), 0.5, source="maps/depot.yaml")


def test_a_map_is_told_by_its_size() -> None:
    route = {"start": [1, 8], "goal": [13, 2]}
    lidar = {"lidar": {"range_m": 5, "fov_deg": 270, "beams": 720}}
    mission = Mission.model_validate(
        {"world": {"known": [{"grid": GRID}]}, "robot": {"sensor": lidar}, "route": route}
    )
    lines = dict(summary(mission))
    assert "map maps/depot.yaml: 30 x 20 cells of 0.5 m, bounds" in lines["world"]
    assert "a lidar with 720 beams of 5 m in 270°" in lines["robot"]


def test_a_plan_names_its_map_in_full_and_the_ledger_without_the_folder() -> None:
    wall = np.zeros((40, 60), bool)
    wall[5:35, 30] = True
    grid = {"grid": Grid(wall, 0.5, source="maps/depot.yaml")}
    mission = Mission.model_validate(
        {"world": {"known": [grid]}, "route": {"start": [5, 10], "goal": [25, 10]}}
    )
    text = _text(plan_tables(plan(mission), "x"))
    assert "maps/depot.yaml: 60 x 40 cells of 0.5 m" in text
    assert "map 'depot.yaml'" in text


def test_clearance_that_is_preferred_is_told_with_its_price() -> None:
    mission = Mission.model_validate(
        {
            "world": {"known": [{"circle": {"center": [50, 1], "radius": 6}}]},
            "robot": {"prefer_clearance_m": 40},
            "route": {"start": [0, 0], "goal": [100, 0]},
        }
    )
    planned = plan(mission)
    assert planned.preferred_clearance is not None
    (line,) = [x for x in _text(plan_tables(planned, "x")).splitlines() if "preferred" in x]
    first = planned.preferred_clearance.tried[0]
    assert first.duration is not None
    later = first.duration - planned.preferred_clearance.duration
    assert f"40.00 m more: +{later:.1f} s" in line
    assert "taken" not in line


def test_a_long_ledger_is_cut_with_a_count() -> None:
    nothing = np.zeros((0, 2))
    taken = Candidate(
        "left", nothing, np.zeros((0, 4, 2)), length=9.0, duration=6.5, clearance=0.5,
        max_curvature=0.1, chosen=True,
    )  # fmt: skip
    entry = LedgerEntry(("a", "b", "c", "d", "e"), ("start", "goal"), (taken,))
    text = _text(ledger_table((entry,) * 49))
    assert text.count("taken") == text.count("6.5 s") == 12
    assert "… and 37 more in plan.json" in text
    assert "a, b, c and 2 more" in text
