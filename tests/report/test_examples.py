from __future__ import annotations

import re
from pathlib import Path

import pytest

from viaspline.formats.load import load
from viaspline.mission.fleet.fleet import Fleet
from viaspline.planner import plan
from viaspline.report.fleet_summary import fleet_summary
from viaspline.report.summary import summary

ROOT = Path(__file__).parents[2]
EXAMPLES = sorted(
    path for path in (ROOT / "examples").iterdir() if path.suffix in (".yaml", ".plan")
)
README = (ROOT / "README.md").read_text(encoding="utf-8")


@pytest.mark.filterwarnings("ignore::viaspline.errors.MissionWarning")
@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.name)
def test_an_example_is_sound_and_listed(path: Path) -> None:
    asked = load(path)
    assert len(fleet_summary(asked) if isinstance(asked, Fleet) else summary(asked)) >= 4
    assert f"`{path.name}`" in (ROOT / "examples" / "README.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", ["depot-round", "street"])
def test_a_round_on_a_map_is_planned_and_proven(name: str) -> None:
    planned = plan(load(ROOT / "examples" / f"{name}.yaml"))
    assert planned.certificate.holds
    assert planned.ledger


def _blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", README, re.DOTALL)


SCRIPTS = [code for code in _blocks("python") if "import viaspline" in code]


@pytest.mark.parametrize("number", range(len(SCRIPTS)))
def test_a_script_of_the_readme_runs(
    number: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(ROOT)
    exec(compile(SCRIPTS[number], "README.md", "exec"), {})
    assert capsys.readouterr().out


@pytest.mark.parametrize("number", range(len(_blocks("yaml"))))
def test_a_piece_of_a_mission_in_the_readme_is_sound(
    number: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = _blocks("yaml")[number]
    text = text.replace("maps/", f"{(ROOT / 'examples' / 'maps').as_posix()}/")
    if "route:" not in text:
        text += "route: {start: [2, 3], goal: [3, 8]}\n"
    (tmp_path / "m.yaml").write_text(text, encoding="utf-8")
    load(tmp_path / "m.yaml")


def test_every_file_that_the_readme_names_is_there() -> None:
    named = re.findall(r"\]\(((?!http)[^)]+)\)|src=\"([^\"]+)\"|(examples/[\w./-]+\w)", README)
    for found in named:
        name = "".join(found).partition("#")[0]  # headings are checked with the docs
        assert (ROOT / name).exists(), found
