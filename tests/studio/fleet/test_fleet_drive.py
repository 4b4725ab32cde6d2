"""A fleet is driven in the studio: what the page is told is what was driven."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import viaspline as vs
from viaspline.studio.fleet.simulated_fleet import SimulatedFleet, driven_fleet_answer

Start = Callable[..., Any]

TEXT = """\
world: {bounds: [-10, -30, 60, 30]}
separation_m: 1.0
robots: {cart: {radius_m: 0.5}}
fleet:
  - name: east
    robot: cart
    route: {start: [0, 0], via: [{at: [12, 0], dwell_s: 3}], goal: [40, 0]}
  - {name: north, robot: cart, priority: 2, depart_s: 1, route: {start: [20, -20], goal: [20, 20]}}
  - {name: third, robot: cart, rest: leave, route: {start: [0, -10], goal: [45, -10]}}
"""


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "fleet.yaml"
    path.write_text(TEXT)
    return path


@pytest.mark.parametrize("delays", [None, vs.Delays(slowed=0.3, halts=1, halts_s=8)])
def test_the_law_that_is_told_has_a_robot_where_it_was(
    file: Path, delays: vs.Delays | None
) -> None:
    fleet = vs.load(file)
    assert isinstance(fleet, vs.Fleet)
    plan = vs.plan_fleet(fleet)
    run = vs.simulate_fleet(fleet, delays, plan, seed=3)
    answer = driven_fleet_answer(SimulatedFleet(plan, run))
    assert answer["reached"]
    assert answer["arrived"] == 3
    assert answer["duration"] == run.end_s
    for robot in answer["robots"]:
        law = {key: np.array(values) for key, values in robot["law"].items()}
        assert (np.diff(law["times"]) >= 0).all()
        assert (np.diff(law["distances"]) >= 0).all()
        times = np.linspace(law["times"][0], law["times"][-1], 500)
        k = np.clip(
            np.searchsorted(law["times"], times, side="right") - 1, 0, len(law["times"]) - 2
        )
        lasts = np.diff(law["times"])[k]
        gone = times - law["times"][k]
        rise = np.divide(np.diff(law["speeds"])[k], lasts, out=np.zeros(500), where=lasts > 0)
        there = law["distances"][k] + law["speeds"][k] * gone + 0.5 * rise * gone**2
        assert there == pytest.approx(run.distance_at(robot["name"], times), abs=5e-3)


def test_who_waited_for_whom_is_told(file: Path) -> None:
    fleet = vs.load(file)
    assert isinstance(fleet, vs.Fleet)
    plan = vs.plan_fleet(fleet)
    run = vs.simulate_fleet(fleet, vs.Delays(halts=2, halts_s=20), plan, seed=1)
    answer = driven_fleet_answer(SimulatedFleet(plan, run))
    told = [(one["kind"], one["robot"]) for one in answer["events"]]
    assert told.count(("arrived", "north")) == 1
    assert len([one for one in told if one[0] == "waits"]) >= len(answer["waits"]) > 0
    for wait in answer["waits"]:
        assert wait["until"] > wait["from"]
        assert {wait["robot"], wait["waits_for"]} <= {"east", "north", "third"}


def test_a_fleet_is_driven_over_the_connection_and_its_files_are_exported(
    start: Start, file: Path
) -> None:
    with start(file).client() as client:
        client.edit()
        assert "drive the mission first" in refusal(client, "run.json")
        driven = client.ask("drive", "driven", id=4, seed=7)
        assert driven["id"] == 4
        assert driven["reached"]
        assert [robot["name"] for robot in driven["robots"]] == ["east", "north", "third"]
        for kind in ("run.json", "run.png", "fleet.json", "fleet.png"):
            assert client.ask("export", "exported", kind=kind)["name"] == f"fleet-{kind}"
        assert "run.json and run.png" in refusal(client, "run.csv")
        client.edit([["fleet", 0, "route", "via", 0], [12, -1]])
        assert "drive the mission first" in refusal(client, "run.json")


def test_a_mission_has_no_files_of_a_fleet(start: Start, tmp_path: Path) -> None:
    path = tmp_path / "one.yaml"
    path.write_text("route: {start: [0, 0], goal: [9, 0]}\n")
    with start(path).client() as client:
        client.edit()
        assert "isn't a fleet" in refusal(client, "fleet.json")


def refusal(client: Any, kind: str) -> str:
    return str(client.ask("export", "refused", kind=kind)["message"])
