"""The command that exports, as a person types it."""

from pathlib import Path

import pytest
from click.testing import CliRunner, Result

import viaspline as vs
from viaspline.cli import cli
from viaspline.formats.mission_format import Whereabouts
from viaspline.formats.mission_yaml import yaml_text
from viaspline.formats.qgc_plan import QgcPlan
from viaspline.formats.qgc_wpl import QgcWpl
from viaspline.report.proven_reference import PROVEN_WORDS

EXAMPLES = Path(__file__).parents[2] / "examples"


def call(*arguments: object) -> Result:
    return CliRunner().invoke(cli, ["export", *map(str, arguments)])


def test_a_mission_is_exported_and_told_about(tmp_path: Path) -> None:
    out = tmp_path / "new" / "patrol.plan"
    result = call(EXAMPLES / "fig8-patrol.yaml", out, "--origin", "47.3977,8.5456")
    assert result.exit_code == 0, result.output
    assert "m clear, for vehicles that turn" in result.output
    assert PROVEN_WORDS in result.output.splitlines()
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
    assert "[147.25, 8.5] isn't a latitude and a longitude" in refused.output


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
        (("fig8-patrol.yaml", "x.plan", "--origin", "north"), "isn't LAT,LON"),
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


GEOGRAPHIC = ("plan", "waypoints", "geojson", "kml", "gpx", "csv")


@pytest.fixture(scope="module")
def placed(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """A mission of each kind of file that says where on earth it lies, in one folder each."""
    root = tmp_path_factory.mktemp("placed")
    files = {}
    route = {"start": [0, 0], "via": [[20, 4]], "goal": [40, 0]}
    known = [{"circle": {"center": [12, 2], "radius": 2}}]
    world = {"known": known, "origin_deg": [47.3977, 8.5456]}
    mission = vs.Mission.model_validate({"world": world, "route": route})
    (root / "of-yaml.yaml").write_text(yaml_text(mission, root), "utf-8")
    files["yaml"] = root / "of-yaml.yaml"
    for kind in (QgcPlan(), QgcWpl()):
        file = root / f"of-{kind.saved_endings[0][1:]}{kind.saved_endings[0]}"
        file.write_text(kind.write(mission, Whereabouts()).text)
        files[kind.saved_endings[0][1:]] = file
    beside = root / "of-studio.yaml"
    beside.write_text(
        yaml_text(
            vs.Mission.model_validate({"world": {"known": known}, "route": route}), beside.parent
        ),
        "utf-8",
    )
    (root / "of-studio.yaml.studio.json").write_text('{"origin": [47.3977, 8.5456]}')
    files["studio"] = beside
    flight = {"start": [0, 0], "takeoff": {"to_agl_m": 8}, "goal": [40, 0, 410]}
    flown = {"world": {**world, "ground": {"flat_m": 400}}, "route": flight}
    (root / "of-flight.yaml").write_text(yaml_text(vs.Mission.model_validate(flown), root), "utf-8")
    files["flight"] = root / "of-flight.yaml"
    return files


@pytest.mark.parametrize(
    "source",
    ["yaml", "plan", "flight",
     *(pytest.param(one, marks=pytest.mark.slow) for one in ("waypoints", "studio"))],
)  # fmt: skip
def test_a_saved_plan_is_exported_where_on_earth_its_mission_lies(
    source: str, placed: dict[str, Path], tmp_path: Path
) -> None:
    mission, saved = placed[source], tmp_path / "saved"
    done = CliRunner().invoke(cli, ["plan", str(mission), "--out", str(saved), "-q"])
    assert done.exit_code == 0, done.output
    loaded = vs.load_plan(saved)
    for ending in GEOGRAPHIC:
        of_mission, of_folder = tmp_path / f"m/way.{ending}", tmp_path / f"f/way.{ending}"
        for given, out in ((mission, of_mission), (saved, of_folder)):
            result = call(given, out, "-q")
            assert result.exit_code == 0, result.output
        assert of_mission.read_bytes() == of_folder.read_bytes()
        loaded.save(tmp_path / f"way.{ending}")
        assert (tmp_path / f"way.{ending}").read_bytes() == of_folder.read_bytes()
    again = vs.origin_of(tmp_path / "way.plan")
    assert again == pytest.approx(loaded.mission.world.origin_deg, abs=1e-9)


def test_a_fleet_that_was_saved_is_exported_where_it_lies(tmp_path: Path) -> None:
    fleet = tmp_path / "fleet.yaml"
    fleet.write_text("fleet:\n  - {name: a, route: {start: [0, 0], goal: [40, 0]}}\n")
    (tmp_path / "fleet.yaml.studio.json").write_text('{"origin": [47.25, 8.5]}')
    saved = tmp_path / "saved"
    done = CliRunner().invoke(cli, ["plan", str(fleet), "--out", str(saved), "-q"])
    assert done.exit_code == 0, done.output
    assert call(saved, tmp_path / "way.kml", "-q").exit_code == 0
    assert "8.5" in (tmp_path / "way-a.kml").read_text()


def test_a_studio_file_that_can_not_be_read_stops_no_plan(tmp_path: Path) -> None:
    mission = tmp_path / "yard.yaml"
    mission.write_text("route: {start: [0, 0], goal: [9, 0]}\n")
    (tmp_path / "yard.yaml.studio.json").write_text("{")
    result = CliRunner().invoke(cli, ["plan", str(mission), "--out", str(tmp_path / "out")])
    assert result.exit_code == 0, result.output
    assert "it is passed over" in result.output
    refused = call(tmp_path / "out", tmp_path / "way.kml")
    assert "in metres without an origin" in " ".join(refused.output.split())
