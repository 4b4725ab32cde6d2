"""Fleets' plans that were saved: equal when they are loaded, and used as any other."""

import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest
from click.testing import CliRunner
from fleets_to_save import ASKED, Saved, unpainted

import viaspline as vs
from viaspline.cli import cli


@pytest.fixture(autouse=True)
def _unpainted() -> Iterator[None]:
    with unpainted():
        yield


def test_what_was_saved_is_of_every_kind(saved: Saved) -> None:
    assert any(one.waits_s > 0.0 for one in saved["crossing"][1].precedences)
    assert {one.name for one in saved["not all served"][1].not_served} == {"a", "b"}
    assert set(saved["not all served"][1].courses.names) > set(saved["not all served"][1].plans)
    patrols = saved["patrols"][1].patrols
    assert patrols is not None
    assert set(patrols.laps) == {"p", "q"}
    assert saved["laps"][1].patrols is None
    assert saved["flights"][1].is_spatial
    assert len(saved["on a lattice"][1].plans) == 4


@pytest.mark.parametrize("name", ASKED)
def test_a_fleets_plan_that_is_loaded_equals_the_one_that_was_saved(
    name: str, saved: Saved
) -> None:
    folder, made = saved[name]
    again = vs.load_fleet_plan(folder)
    assert again == made
    assert hash(again) == hash(made)
    assert again.fleet == made.fleet
    assert vs.load_fleet_plan(str(folder / "fleet.json"), made.fleet) == made


@pytest.mark.parametrize("change", ["added", "removed", "rerouted"])
def test_a_plan_that_was_changed_is_loaded_again_with_its_fleet(
    change: str, saved: Saved, tmp_path: Path
) -> None:
    plan = saved["crossing"][1]
    there = vs.Mission.model_validate(
        {"world": plan.fleet.world, "route": {"start": [32, -20], "goal": [32, 20]}}
    )
    made = {
        "added": lambda: vs.add_robot(plan, vs.FleetMember("d", there)),
        "removed": lambda: vs.remove_robot(plan, "a"),
        "rerouted": lambda: vs.reroute_robot(plan, vs.FleetMember("a", there)),
    }[change]()
    with pytest.warns(vs.MissionWarning, match=r"made in memory.*load_fleet_plan"):
        made.save(tmp_path)
    with pytest.raises(vs.SavedPlanError, match="give load_fleet_plan the fleet"):
        vs.load_fleet_plan(tmp_path)
    assert vs.load_fleet_plan(tmp_path, made.fleet) == made


def test_a_loaded_plan_is_driven_exported_and_saved_as_any_other(
    saved: Saved, tmp_path: Path
) -> None:
    folder, made = saved["crossing"]
    again = vs.load_fleet_plan(folder)
    run = vs.simulate_fleet(again.fleet, plan=again, delays=vs.Delays(slowed=0.2), seed=3)
    assert run == vs.simulate_fleet(made.fleet, plan=made, delays=vs.Delays(slowed=0.2), seed=3)
    told = [vs.FleetNavigator(one, warm=False).step((), 0.0)[0] for one in (again, made)]
    assert told[0] == told[1]
    again.save(tmp_path / "again")
    assert vs.load_fleet_plan(tmp_path / "again") == made
    called = ["export", str(folder), str(tmp_path / "round.csv"), "--quiet"]
    assert CliRunner().invoke(cli, called).exit_code == 0
    files = vs.export_fleet(made, tmp_path / "made.csv").values()
    exported = [one.path.read_bytes() for one in files if one.path is not None]
    assert [one.read_bytes() for one in sorted(tmp_path.glob("round*.csv"))] == exported
    assert vs.remove_robot(again, "a") == vs.remove_robot(made, "a")


def test_another_fleet_is_refused(saved: Saved) -> None:
    folder, _made = saved["crossing"]
    grown = vs.Fleet.model_validate(
        {**ASKED["crossing"], "world": {"known": [{"circle": {"center": [30, 0], "radius": 2}}]}}
    )
    with pytest.raises(vs.SavedPlanError, match=r"clearance|keep"):
        vs.load_fleet_plan(folder, grown)
    fewer = vs.Fleet.model_validate({**ASKED["crossing"], "fleet": ASKED["crossing"]["fleet"][:2]})
    with pytest.raises(vs.SavedPlanError, match="other robots than the fleet: 'c'"):
        vs.load_fleet_plan(folder, fewer)
    stays = vs.Fleet.model_validate(
        {
            **ASKED["crossing"],
            "fleet": [{**one, "rest": "stay"} for one in ASKED["crossing"]["fleet"]],
        }
    )
    with pytest.raises(vs.SavedPlanError, match=r"isn't that of its plan|than its limits"):
        vs.load_fleet_plan(folder, stays)


def test_what_is_no_plan_of_a_fleet_is_told(saved: Saved, tmp_path: Path) -> None:
    with pytest.raises(vs.SavedPlanError, match=r"no planned-fleet\.yaml beside it"):
        vs.load_fleet_plan(tmp_path)
    with pytest.raises(vs.MissionError, match="there is no such file"):
        vs.load_fleet_plan(tmp_path, saved["crossing"][1].fleet)
    with pytest.raises(vs.GeometryError, match="folder is of the class int"):
        vs.load_fleet_plan(5)  # type: ignore[arg-type]
    with pytest.raises(vs.SavedPlanError, match="call load_fleet_plan"):
        vs.load_plan(saved["crossing"][0])
    shutil.copytree(saved["crossing"][0], tmp_path / "copy")
    (tmp_path / "copy" / "courses.npz").unlink()
    with pytest.raises(vs.MissionError, match="there is no such file"):
        vs.load_fleet_plan(tmp_path / "copy")
