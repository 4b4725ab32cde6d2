from collections.abc import Callable
from pathlib import Path
from typing import Any

import click
import pytest
from click.testing import CliRunner, Result

from viaspline.cli import cli
from viaspline.kernels import kernel_cache
from viaspline.warming import warm_everything, warm_up
from viaspline.warming.mission_kind import MissionKind

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


@pytest.fixture
def warm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., Result]:
    monkeypatch.setattr(kernel_cache, "CACHE_FOLDER", tmp_path)
    return lambda *words: CliRunner().invoke(cli, ["warm", *map(str, words)])


@pytest.mark.parametrize("words", [(), ("--all", EXAMPLES / "fig8-patrol.yaml")])
def test_it_wants_a_mission_or_all_and_not_both(warm: Callable[..., Result], words: Any) -> None:
    result = warm(*words)
    assert result.exit_code == 2
    assert "give a mission, or --all" in result.stderr


@pytest.mark.parametrize(
    ("file", "kinds"),
    [
        ("fig8-patrol", ["plain"]),
        ("barn-unseen", ["lidar"]),
        ("yard-rover", ["ackermann+footprint+turning+zones"]),
        ("crossing-carts", ["moving"]),
        ("plant-inspection", ["space"]),
        ("corridor-bay", ["fleet"]),
    ],
)
def test_it_warms_the_kinds_of_a_mission_and_says_so(
    warm: Callable[..., Result], monkeypatch: pytest.MonkeyPatch, file: str, kinds: list[str]
) -> None:
    asked: list[str] = []

    def kind_warmed(kind: MissionKind, key: str, tell: Callable[[str], None]) -> None:
        asked.append(kind.name)
        tell("disc.conflicts")

    monkeypatch.setattr(warm_up, "warm_kind", kind_warmed)
    result = warm(EXAMPLES / f"{file}.yaml")
    assert (result.exit_code, asked) == (0, kinds), result.output
    *lines, last = result.stdout.splitlines()
    assert [line.split()[0] for line in lines] == kinds
    assert last.startswith(f"{len(kinds)} kernels compiled in ")
    assert warm("-q", EXAMPLES / f"{file}.yaml").stdout == ""


def test_all_of_it_names_each_kind_and_what_failed(
    warm: Callable[..., Result], monkeypatch: pytest.MonkeyPatch
) -> None:
    def done_at_once(kinds: Any, tell: Any, done: Any) -> None:
        for kind in kinds:
            tell("a.b")
            done(kind, 1.5, kind.name != broken)

    monkeypatch.setattr(warm_everything, "warm_everything", done_at_once)
    broken = ""
    result = warm("--all")
    assert result.exit_code == 0
    names = [kind.name for kind in warm_everything.every_kind()]
    assert [line.split()[0] for line in result.stdout.splitlines()[:-1]] == names
    broken = "lidar"
    result = warm("--all")
    assert result.exit_code == 2
    assert "not all of lidar could be compiled" in result.stderr
    assert "record_kind lidar says why" in result.stderr


def test_where_nothing_can_be_kept_it_says_what_to_do(
    warm: Callable[..., Result], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(kernel_cache, "CACHE_FOLDER", None)
    result = warm("--all")
    assert result.exit_code == 2
    assert "set VIASPLINE_CACHE_DIR" in result.stderr


@pytest.mark.parametrize("name", ["", *sorted(cli.commands)])
def test_no_help_shows_the_mark_of_what_is_not_wrapped(name: str) -> None:
    told = CliRunner().invoke(cli, [*([name] if name else []), "--help"]).stdout
    assert "\\b" not in told
    command: click.Command = cli.commands[name] if name else cli
    examples = {line.strip() for line in (command.help or "").splitlines()}
    examples = {line for line in examples if line.startswith("viaspline ")}
    assert examples
    assert examples <= {line.strip() for line in told.splitlines()}
