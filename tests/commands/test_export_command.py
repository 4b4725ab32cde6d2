"""The command that exports, as a person types it."""

from pathlib import Path

import pytest
from click.testing import CliRunner, Result

import viaspline as vs
from viaspline.cli import cli

EXAMPLES = Path(__file__).parents[2] / "examples"


def call(*arguments: object) -> Result:
    return CliRunner().invoke(cli, ["export", *map(str, arguments)])


def test_a_mission_is_exported_and_told_about(tmp_path: Path) -> None:
    out = tmp_path / "new" / "patrol.plan"
    result = call(EXAMPLES / "fig8-patrol.yaml", out, "--origin", "47.3977,8.5456")
    assert result.exit_code == 0, result.output
    assert "m clear, for vehicles that turn" in result.output
    assert "not carried: times" in result.output
    assert f"wrote {out}" in " ".join(result.output.split())
    assert out.exists()


def test_the_origin_of_a_plan_of_others_is_its_own(tmp_path: Path) -> None:
    out = tmp_path / "survey.kml"
    result = call(EXAMPLES / "fence-survey.plan", out, "-q", "--chord-error", "0.2")
    assert result.exit_code == 0, result.output
    assert "<LineString>" in out.read_text()


def test_an_origin_that_was_set_in_the_studio_is_taken_and_told(tmp_path: Path) -> None:
    mission, out = tmp_path / "yard.yaml", tmp_path / "yard.kml"
    mission.write_text("route: {start: [0, 0], goal: [9, 0]}\n")
    beside = tmp_path / "yard.yaml.studio.json"
    beside.write_text('{"origin": [47.25, 8.5]}\n')
    result = call(mission, out)
    assert result.exit_code == 0, result.output
    assert "note: 0, 0 lies at 47.25, 8.5, as yard.yaml.studio.json says" in result.output
    assert "8.5001188896,47.2499999999" in out.read_text()
    assert "studio.json" not in call(mission, out, "--origin", "46,7").output  # somebody says it
    beside.write_text('{"origin": [147.25, 8.5]}\n')
    assert call(mission, tmp_path / "yard.csv", "-q").exit_code == 0  # which needs none
    refused = call(mission, out)
    assert refused.exit_code == 2
    assert "[147.25, 8.5] is no latitude and longitude" in refused.output


def test_a_plan_that_was_saved_is_exported_as_its_mission_is(tmp_path: Path) -> None:
    mission = EXAMPLES / "fig7-obstacles.yaml"
    saved, out = tmp_path / "saved", tmp_path / "line.gpx"
    vs.plan(mission).save(saved)
    assert call(mission, out, "-q", "--origin", "47,8").exit_code == 0
    planned = out.read_bytes()
    for given in (saved, saved / "plan.json"):
        out.unlink()
        result = call(given, out, "--origin", "47,8")
        assert result.exit_code == 0, result.output
        assert out.read_bytes() == planned
    (saved / "planned-mission.yaml").unlink()
    assert call(saved, out, "--origin", "47,8").exit_code == 2


def test_each_robot_of_a_fleet_has_its_file(tmp_path: Path) -> None:
    result = call(EXAMPLES / "corridor-bay.yaml", tmp_path / "bay.csv")
    assert result.exit_code == 0, result.output
    names = sorted(file.name for file in tmp_path.iterdir())
    assert names == ["bay-eastbound.csv", "bay-westbound.csv"]
    assert "who waits for whom" in result.output


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("fig8-patrol.yaml", "x.plan"), "--origin LAT,LON"),
        (("fig8-patrol.yaml", "x.dxf"), "the endings are"),
        (("fig8-patrol.yaml", "x"), "the endings are"),
        (("fig8-patrol.yaml", "x.plan", "--origin", "north"), "is no LAT,LON"),
        (("fig8-patrol.yaml", "x.plan", "--origin", "91,0"), "can't be the origin"),
        (("fig8-patrol.yaml", "x.csv", "--chord-error", "-1"), "chord-error"),
        (("fig8-patrol.yaml", "x.csv", "--chord-error", "0"), "chord_error is 0"),
        (("missing.yaml", "x.csv"), "there is no such file"),
        ((".", "x.csv"), "plan.json: there is no such file"),
    ],
)
def test_what_can_not_be_exported_is_refused_in_words_before_the_work(
    arguments: tuple[str, ...], words: str, tmp_path: Path
) -> None:
    mission, out, *more = arguments
    result = call(EXAMPLES / mission, tmp_path / out, *more)
    assert result.exit_code == 2
    assert words in " ".join(result.output.split())
    assert "Traceback" not in result.output
    assert not list(tmp_path.iterdir())


def test_its_help_has_examples() -> None:
    lines = [line.strip() for line in call("--help").output.splitlines()]
    assert "viaspline export examples/fence-survey.plan survey.kml" in lines


@pytest.mark.parametrize("command", ["", "run", "plan", "check", "export"])
def test_examples_in_a_help_keep_their_lines(command: str) -> None:
    shown = CliRunner().invoke(cli, [*command.split(), "--help"]).output
    assert "\\b" not in shown
    assert any(line.strip().startswith("viaspline ") for line in shown.splitlines())
