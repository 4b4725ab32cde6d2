"""``viaspline run --bag`` and ``viaspline replay`` at the command line."""

from pathlib import Path

import pytest
from click.testing import CliRunner

from viaspline.cli import cli
from viaspline.commands.replay_command import replay

ROBOT = "robot: {max_speed_mps: 1}\n"
MISSION = ROBOT + "route: {start: [0, 0], via: [[4, 2]], goal: [9, 0]}\n"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with a mission."""
    (tmp_path / "short.yaml").write_text(MISSION)
    return tmp_path


def test_a_drive_is_recorded_and_replayed(folder: Path) -> None:
    bag = folder / "run.mcap"
    run = CliRunner().invoke(
        cli, ["run", f"{folder}/short.yaml", "--out", f"{folder}/out", "--bag", str(bag)]
    )
    assert run.exit_code == 0, run.output
    assert f"wrote run.mcap into {folder}" in run.output
    again = CliRunner().invoke(cli, ["replay", str(bag)])
    assert again.exit_code == 0, again.output
    assert "the same in all of its" in again.output
    quiet = CliRunner().invoke(replay, [str(bag), "-q"])
    assert quiet.stdout == ""
    data = bag.read_bytes()
    bag.write_bytes(data[:-40])
    cut = CliRunner().invoke(cli, ["replay", str(bag)])
    assert cut.exit_code == 0
    assert "is cut short" in cut.output


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("robot: {half_height_m: 1}\nroute: {start: [0, 0, 5], goal: [9, 0, 5]}\n", "in space"),
        (
            "fleet:\n- {name: a, route: {start: [0, 0], goal: [9, 0]}}\n"
            "- {name: b, route: {start: [0, 5], goal: [9, 5]}}\n",
            "of a fleet",
        ),
    ],
)
def test_missions_without_a_navigator_have_no_bag(folder: Path, text: str, words: str) -> None:
    (folder / "other.yaml").write_text(text)
    done = CliRunner().invoke(cli, ["run", f"{folder}/other.yaml", "--bag", f"{folder}/a.mcap"])
    assert done.exit_code == 2
    assert words in done.output
    assert not (folder / "a.mcap").exists()


def test_what_is_no_bag_is_an_error_of_the_arguments(folder: Path) -> None:
    done = CliRunner().invoke(cli, ["replay", f"{folder}/short.yaml"])
    assert done.exit_code == 2
    assert "an MCAP file" in done.output
    missing = CliRunner().invoke(cli, ["replay", f"{folder}/missing.mcap"])
    assert missing.exit_code == 2
    assert "there is no such file; give a .mcap" in missing.output
    assert "driving again" not in missing.output
    vague = CliRunner().invoke(cli, ["replay", f"{folder}/short.yaml", "--tolerance", "nan"])
    assert vague.exit_code == 2
    assert "tolerance is nan" in vague.output
    for bag in ("run.bag", "short.yaml/run.mcap"):
        refused = CliRunner().invoke(
            cli, ["run", f"{folder}/short.yaml", "--out", f"{folder}/o", "--bag", f"{folder}/{bag}"]
        )
        assert refused.exit_code == 2
        assert not (folder / "o").exists()
