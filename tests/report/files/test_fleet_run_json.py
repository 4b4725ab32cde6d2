"""What a drive of a fleet leaves in its folder, and says on the terminal."""

from __future__ import annotations

import json
from dataclasses import replace
from io import StringIO

import pytest
from rich.console import Console

import viaspline as vs
from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.report.files.fleet_run_json import fleet_run_json
from viaspline.report.terminal.fleet_tables import fleet_run_table, too_near_words

FLEET = {
    "separation_m": 1,
    "robots": {"cart": {"radius_m": 0.5}},
    "fleet": [
        {"name": "east", "robot": "cart", "route": {"start": [0, 0], "goal": [40, 0]}},
        {"name": "north", "robot": "cart", "route": {"start": [20, -20], "goal": [20, 20]}},
    ],
}


@pytest.fixture(scope="module")
def run() -> FleetRun:
    fleet = vs.Fleet.model_validate(FLEET)
    return vs.simulate_fleet(fleet, vs.Delays(slowed=0.3, halts=1, halts_s=10), seed=3)


def test_run_json_says_when_each_arrived_and_how_near_any_two_came(run: FleetRun) -> None:
    data = json.loads(fleet_run_json(run, "yard", seed=3))
    assert data["fleet"] == {"name": "yard", "seed": 3}
    assert data["reached"] is True
    assert data["deadlock"] == []
    assert [robot["name"] for robot in data["robots"]] == ["east", "north"]
    for robot in data["robots"]:
        assert robot["arrived_s"] == run.arrivals[robot["name"]]
        assert robot["delay_s"] == run.delays[robot["name"]]
    assert data["certificate"]["separation_m"] >= 1.0 - 1e-6
    arrived = [event["robot"] for event in data["events"] if event["kind"] == "arrived"]
    assert sorted(arrived) == ["east", "north"]


def test_the_table_says_who_arrived_and_how_late(run: FleetRun) -> None:
    console = Console(width=160, record=True, file=StringIO())
    console.print(fleet_run_table(run, "yard"))
    text = console.export_text()
    assert "2 of 2" in text
    assert "later than planned" in text
    assert "(asked 1.00 m)" in text


def test_robots_that_came_too_near_are_warned_of(run: FleetRun) -> None:
    assert too_near_words(run.certificate) is None
    pair = ("east", "north")
    near = replace(run.certificate, separation=0.5, required=1.0, pair=pair, at_s=4.0)
    words = "'east' and 'north' drove as near as 0.500 m after 4.0 s, 1.00 m are asked"
    assert too_near_words(near) == words
