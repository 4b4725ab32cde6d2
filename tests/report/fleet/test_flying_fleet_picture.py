"""The pictures, files and words of fleets in space."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from click.testing import CliRunner
from PIL import Image

import viaspline as vs
from viaspline.cli import cli
from viaspline.errors import GeometryError
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.report.files.fleet_json import fleet_json
from viaspline.report.fleet.fleet_colours import ROBOT_COLOURS
from viaspline.report.fleet.fleet_picture import fleet_picture, motion_of
from viaspline.report.fleet.fleet_run_picture import fleet_run_picture
from viaspline.report.fleet.places_over_time import least_gap, least_gap_in_space
from viaspline.report.style import MOVING_FILL

FLEET: dict[str, Any] = {
    "world": {
        "ground": {"flat_m": 0},
        "known": [
            {"name": "tower", "circle": {"center": [20, 3], "radius": 2}, "height_m": [0, 18]}
        ],
    },
    "separation_m": 2,
    "robots": {"drone": {"radius_m": 0.4, "half_height_m": 0.2, "max_speed_mps": 4}},
    "fleet": [
        {"name": "a", "route": {"start": [0, 0], "takeoff": {"to_agl_m": 10},
                                "land": {"at": [40, 0]}}},
        {"name": "b", "rest": "leave", "route": {"start": [20, -20, 10], "goal": [20, 20, 12]}},
        {"name": "c", "route": {"start": [0, 9, 5], "via": [[10, 9, 12]], "goal": [40, 9, 5]}},
    ],
}  # fmt: skip


@pytest.fixture(scope="module")
def planned() -> FleetPlan:
    return vs.plan_fleet(vs.Fleet.model_validate(FLEET))


def share_of(colour: str, picture: bytes) -> float:
    wanted = [int(colour[i : i + 2], 16) for i in (1, 3, 5)]
    pixels = np.asarray(Image.open(io.BytesIO(picture)).convert("RGB")).astype(int)
    return float((np.abs(pixels - wanted).max(axis=2) < 12).mean())


@pytest.mark.slow
def test_all_robots_are_on_the_picture_and_it_is_the_same_every_time(planned: FleetPlan) -> None:
    picture = fleet_picture(planned, "tower")
    for colour in ROBOT_COLOURS[:3]:
        assert share_of(colour, picture) > 1e-4
    assert fleet_picture(planned, "tower") == picture


def test_the_nearest_two_over_time_are_no_nearer_than_proven(planned: FleetPlan) -> None:
    motion = motion_of(planned)
    near = motion.nearest_two()
    assert np.nanmin(near.gaps) >= planned.certificate.separation - 1e-6
    assert np.nanmin(near.gaps) <= planned.certificate.separation + 0.05
    assert motion.heights is not None
    assert np.isnan(motion.heights[1, -1])  # b has left
    assert motion.heights[0, -1] == pytest.approx(0.2)


def test_balls_in_a_plane_have_the_gap_of_discs() -> None:
    rng = np.random.default_rng(1)
    places, radii = rng.uniform(0, 20, (7, 2)), rng.uniform(0.1, 0.5, 7)
    flat = np.column_stack((places, np.zeros(7)))
    sizes = np.column_stack((np.zeros((7, 2)), radii))
    assert least_gap_in_space(flat, sizes) == pytest.approx(least_gap(places, radii))
    assert least_gap_in_space(flat[:1], sizes[:1]) == np.inf


def test_a_fleet_in_space_is_driven_by_its_orders_and_proven(planned: FleetPlan) -> None:
    from viaspline.fleet.execution.delays import Delays

    for delays in (None, Delays(slowed=0.3, halts=1, halts_s=10)):
        run = vs.simulate_fleet(planned.fleet, delays, planned, seed=3)
        assert run.reached
        assert run.certificate.separation >= 2.0 - 1e-6
        assert share_of(ROBOT_COLOURS[0], fleet_run_picture(planned, run, "tower")) > 1e-4


def test_a_navigator_grants_ways_and_refuses_to_send_robots_elsewhere(planned: FleetPlan) -> None:
    nav = vs.FleetNavigator(planned)
    reports = [vs.ProgressReport(name, 0.0, 0.0) for name in ("a", "b", "c")]
    commands, nav = nav.step(reports, 0.0)
    assert commands["a"].granted > 0.0
    with pytest.raises(GeometryError, match="there is a robot 'c' already"):
        nav.with_robot(FleetMember("c", planned.fleet.members[2].mission))


def test_plans_that_are_led_off_their_paths_are_in_the_plane(planned: FleetPlan) -> None:
    with pytest.raises(GeometryError, match="this is a fleet in space"):
        _ = planned.planar_plans


def test_the_files_have_heights(planned: FleetPlan) -> None:
    data = json.loads(fleet_json(planned, "tower", {name: name for name in "abc"}))
    assert "z up" in data["fleet"]["frame"]
    assert len(data["certificate"]["at"][0]) == 3


def test_the_command_line_plans_and_drives_it(tmp_path: Path) -> None:
    file = tmp_path / "tower.yaml"
    file.write_text(yaml.safe_dump(FLEET))
    done = CliRunner().invoke(cli, ["run", str(file), "--out", str(tmp_path / "out")])
    assert done.exit_code == 0, done.output
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert names == {
        "a", "b", "c", "courses.npz", "fleet.json", "fleet.png", "planned-fleet.yaml", "run.json",
        "run.png", "timing.json",
    }  # fmt: skip
    plan = json.loads((tmp_path / "out" / "a" / "plan.json").read_text())
    assert len(plan["path"]["spans"][0][0]) == 3
    checked = CliRunner().invoke(cli, ["check", str(file)])
    assert checked.exit_code == 0, checked.output
    assert "3 robots" in checked.output


def test_a_fleet_of_which_nobody_has_a_path_has_a_picture() -> None:
    walls = [[-3, -3, 0, 3, -2.5, 7], [-3, 2.5, 0, 3, 3, 7], [-3, -3, 0, -2.5, 3, 7],
             [2.5, -3, 0, 3, 3, 7], [-3, -3, 5, 3, 3, 7]]  # fmt: skip
    plan = vs.plan_fleet(vs.Fleet.model_validate({
        "world": {"ground": {"flat_m": 0}, "altitude": {"max_m": 40},
                  "known": [{"box": {"min": wall[:3], "max": wall[3:]}} for wall in walls]},
        "robots": {"drone": {"radius_m": 0.4}},
        "fleet": [{"name": "shut in", "route": {"start": [0, 0, 2.5], "goal": [30, 0, 10]}}],
    }))  # fmt: skip
    assert not plan.plans
    assert plan.not_served[0].name == "shut in"
    assert fleet_picture(plan, "nobody")


@pytest.mark.slow
def test_what_moves_is_on_the_picture_of_a_fleet_in_space_and_in_the_plane() -> None:
    tram = {"name": "tram", "motion": {"from": [12, -14], "velocity_mps": [0, 2]},
            "circle": {"center": [0, 0], "radius": 3}}  # fmt: skip
    fleets = [
        ({**tram, "height_m": [0, 20]}, {"start": [0, 0, 9], "goal": [40, 0, 9]}),
        (tram, {"start": [0, 0], "goal": [40, 0]}),
    ]
    for thing, route in fleets:
        data = {"world": {"known": [thing]}, "fleet": [{"name": "a", "route": route}]}
        plan = vs.plan_fleet(vs.Fleet.model_validate(data))
        assert share_of(MOVING_FILL, fleet_picture(plan, "x")) > 2e-3
