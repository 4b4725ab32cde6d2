from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from viaspline import __version__
from viaspline.cli import cli
from viaspline.errors import MissionWarning
from viaspline.kernels.kernel_cache import CACHE_FOLDER

EXAMPLES = Path(__file__).parents[1] / "examples"
PLAN_FILES = {"plan.json", "path.csv", "plan.png", "planned-mission.yaml", "timing.json"}
RUN_FILES = PLAN_FILES | {"run.json", "run.csv", "run.png"}

CLEAR = "route: {start: [0, 0], goal: [20, 5]}\n"
WALLED = """\
world:
  bounds: [0, 0, 100, 100]
  known:
    - {name: wall, polygon: [[50, 0], [54, 0], [54, 100], [50, 100]]}
route: {start: [10, 50], goal: [90, 50]}
"""
COVERED = """\
world:
  unseen:
    - {name: "tent [red]", circle: {center: [60, 0], radius: 6}}
robot: {sensor: {range_m: 20}}
route: {start: [0, 0], goal: {at: [60, 0], name: camp}}
"""
FAULTY = """\
robot: {radius_m: -1, clearence_m: 0.5}
route: {start: [0, 0], goal: [20, x]}
"""


def call(*arguments: object) -> Result:
    return CliRunner().invoke(cli, [str(argument) for argument in arguments])


def process(
    *arguments: object, cwd: Path, env: dict[str, str] | None = None
) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-m", "viaspline", *map(str, arguments)],
        cwd=cwd, env=env, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip


@pytest.fixture
def clear(tmp_path: Path) -> Path:
    file = tmp_path / "clear.yaml"
    file.write_text(CLEAR)
    return file


def test_every_help_has_an_example() -> None:
    assert "Example" in call("--help").stdout
    for command in cli.commands:
        assert f"viaspline {command} " in call(command, "--help").stdout


def test_commands_that_come_later_are_not_offered() -> None:
    assert "sweep" not in cli.commands


def test_the_version_is_told() -> None:
    assert __version__ in call("--version").stdout


def test_check_sums_up_a_sound_mission(clear: Path) -> None:
    result = call("check", clear)
    assert result.exit_code == 0
    assert "is sound" in result.stdout
    assert "2 points, 20.6 m from point to point" in result.stdout
    assert result.stderr == ""


def test_check_names_every_fault_on_a_line_that_is_never_wrapped(tmp_path: Path) -> None:
    file = tmp_path / f"{'long' * 40}.yaml"
    file.write_text(FAULTY)
    result = call("check", file)
    lines = result.stderr.splitlines()
    assert result.exit_code == 2
    assert len(lines) == 3
    assert all(line.startswith(f"{file}:") for line in lines)
    assert "robot.radius_m:" in lines[0]
    assert "clearance_m" in lines[1]
    assert ":2:35: route.goal.at[1]:" in lines[2]


def test_check_prints_the_schema_without_a_mission() -> None:
    schema = json.loads(call("check", "--schema").stdout)
    assert "route" in schema["properties"]


def test_check_without_a_mission_says_what_to_give() -> None:
    result = call("check")
    assert result.exit_code == 2
    assert "give a mission, or --schema" in result.stderr


def test_a_mission_that_is_not_there_is_named() -> None:
    result = call("plan", "nowhere.yaml")
    assert result.exit_code == 2
    assert result.stderr.startswith("nowhere.yaml: there is no such file")


def test_plan_writes_its_files_and_says_so(clear: Path, tmp_path: Path) -> None:
    result = call("plan", clear, "--out", tmp_path / "out")
    assert result.exit_code == 0, result.stderr
    assert set(os.listdir(tmp_path / "out")) == PLAN_FILES
    assert "length" in result.stdout
    assert f"into {tmp_path / 'out'}" in result.stdout


def test_the_default_folder_has_the_name_of_the_mission(
    clear: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert call("plan", clear, "--quiet").exit_code == 0
    assert set(os.listdir(tmp_path / "viaspline-out" / "clear")) == PLAN_FILES


def test_quiet_says_nothing(clear: Path, tmp_path: Path) -> None:
    result = call("run", clear, "--out", tmp_path / "out", "--quiet", "--seed", 7)
    assert (result.exit_code, result.stdout, result.stderr) == (0, "", "")
    run = json.loads((tmp_path / "out" / "run.json").read_text())
    assert run["mission"]["seed"] == 7


def test_a_seed_below_0_is_refused_before_anything_is_planned(clear: Path, tmp_path: Path) -> None:
    result = call("run", clear, "--out", tmp_path / "out", "--seed", -1)
    assert result.exit_code == 2
    assert "-1 is not in the range x>=0" in result.stderr
    assert not (tmp_path / "out").exists()


def test_no_path_is_explained_and_leaves_no_folder(tmp_path: Path) -> None:
    file = tmp_path / "walled.yaml"
    file.write_text(WALLED)
    result = call("run", file, "--out", tmp_path / "out" / "deep")
    assert result.exit_code == 3
    assert "there is no such path: " in result.stderr
    assert "\n  where:  (" in result.stderr
    assert "\n  remedy: " in result.stderr
    assert not (tmp_path / "out").exists()


def test_a_search_that_gave_up_is_no_refusal(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A wall with slots: too narrow, that is proven; wide enough, a budget of nothing gives up."""

    def asked(half: float) -> Path:
        slots = [4 + 9 * k for k in range(11)]
        ends = [0.0, *(y + d for y in slots for d in (-half, half)), 100.0]
        rings = [
            [[49, low], [51, low], [51, high], [49, high]]
            for low, high in zip(ends[::2], ends[1::2], strict=True)
        ]
        file = tmp_path / "slots.json.yaml"
        file.write_text(json.dumps({
            "world": {"bounds": [0, 0, 100, 100], "known": [{"polygon": ring} for ring in rings]},
            "robot": {"radius_m": 1.0, "clearance_m": 0.0},
            "route": {"start": [10, 50], "goal": [90, 50]},
        }))  # fmt: skip
        return file

    refused = call("plan", asked(0.9995), "--out", tmp_path / "out")
    assert refused.exit_code == 3
    assert "there is no such path: " in refused.stderr
    from viaspline.planning.routing import router
    from viaspline.planning.routing.lattice_route import LatticeRoute

    slight = partial(router.Router, methods=(LatticeRoute(max_gaps=0),))
    monkeypatch.setattr("viaspline.planning.routing.path_problem.Router", slight)
    result = call("plan", asked(1.01), "--out", tmp_path / "out")
    assert result.exit_code == 5
    assert "gave up: no way from 'start' to 'goal' was found" in result.stderr
    assert "\n  where:  (" in result.stderr
    assert "\n  tried:  cells of " in result.stderr
    assert "\n  remedy: " in result.stderr
    assert "there is no such path" not in result.stderr
    assert not (tmp_path / "out").exists()


def test_a_failure_says_when_older_results_are_still_there(clear: Path, tmp_path: Path) -> None:
    assert call("plan", clear, "--out", tmp_path / "out").exit_code == 0
    clear.write_text(WALLED)
    result = call("plan", clear, "--out", tmp_path / "out")
    assert result.exit_code == 3
    assert "is from an earlier run" in result.stderr


def test_a_goal_that_is_not_reached_is_explained_and_reported(tmp_path: Path) -> None:
    file = tmp_path / "covered.yaml"
    file.write_text(COVERED)
    result = call("run", file, "--out", tmp_path / "out")
    assert result.exit_code == 4
    assert "the robot did not reach its goal: " in result.stderr
    assert "tent [red]" in result.stderr
    assert "it stands at (" in result.stderr
    assert set(os.listdir(tmp_path / "out")) == RUN_FILES
    run = json.loads((tmp_path / "out" / "run.json").read_text())
    assert run["reached"] is False
    assert run["vias"][-1]["status"] == "failed"


def _must_not_plan(*_: object) -> None:
    raise AssertionError("the long work began")


@pytest.mark.parametrize("command", ["plan", "run"])
def test_a_folder_that_cannot_be_is_found_before_the_work(
    command: str, clear: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("viaspline.planner.plan", _must_not_plan)
    (tmp_path / "taken").write_text("")
    result = call(command, clear, "--out", tmp_path / "taken")
    assert result.exit_code == 2
    assert "taken: is a file, not a folder; give another folder" in result.stderr


@pytest.mark.parametrize("film", ["run.avi", "run", "taken/run.gif"])
def test_a_film_that_cannot_be_is_found_before_the_work(
    film: str, clear: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("viaspline.planner.plan", _must_not_plan)
    (tmp_path / "taken").write_text("")
    result = call("run", clear, "--out", tmp_path / "out", "--animate", tmp_path / film)
    assert result.exit_code == 2
    assert Path(film).parts[0] in result.stderr
    assert not (tmp_path / "out").exists()


def test_an_animation_is_written(
    clear: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("viaspline.report.animation.MAX_FRAMES", 10)
    film = tmp_path / "film" / "run.gif"
    result = call("run", clear, "--out", tmp_path / "out", "--animate", film)
    assert result.exit_code == 0, result.stderr
    assert film.read_bytes().startswith(b"GIF89a")
    assert "wrote run.gif into" in result.stdout


def test_a_warning_is_one_line(
    clear: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import warnings

    from viaspline.formats import load as reader

    usual = reader.load

    def warn(path: Path) -> object:
        warnings.warn("clear.yaml: a gimbal can't be represented", MissionWarning, stacklevel=1)
        return usual(path)

    monkeypatch.setattr(reader, "load", warn)
    result = call("check", clear)
    assert result.exit_code == 0
    assert result.stderr == "warning: clear.yaml: a gimbal can't be represented\n"


def test_a_defect_is_one_line_that_says_how_to_see_more(
    clear: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise ZeroDivisionError("of\nall things")

    monkeypatch.setattr("viaspline.planner.plan", fail)
    monkeypatch.delenv("VIASPLINE_DEBUG", raising=False)
    result = call("plan", clear, "--out", tmp_path / "out")
    assert result.exit_code == 1
    assert result.stderr == (
        "viaspline: defect: ZeroDivisionError: of all things (VIASPLINE_DEBUG=1 shows where)\n"
    )
    monkeypatch.setenv("VIASPLINE_DEBUG", "1")
    assert "Traceback" in call("plan", clear, "--out", tmp_path / "out").stderr


@pytest.mark.parametrize("mission", ["fig8-patrol.yaml", "fence-survey.plan"])
def test_an_example_runs_and_gives_the_same_bytes_twice(mission: str, tmp_path: Path) -> None:
    job = process("run", EXAMPLES / mission, "--out", "one", cwd=tmp_path)
    out, err = job.communicate(timeout=300)
    assert job.returncode == 0, err
    assert "Traceback" not in out + err
    here = call("run", EXAMPLES / mission, "--out", tmp_path / "two")
    assert here.exit_code == 0, here.output
    assert set(os.listdir(tmp_path / "one")) == RUN_FILES
    for name in RUN_FILES - {"timing.json"}:
        assert (tmp_path / "one" / name).read_bytes() == (tmp_path / "two" / name).read_bytes()
    plan = json.loads((tmp_path / "one" / "plan.json").read_text())
    run = json.loads((tmp_path / "one" / "run.json").read_text())
    required = plan["mission"]["required_clearance_m"]
    assert plan["certificate"]["clearance_m"] is None or plan["certificate"]["holds"]
    assert run["reached"]
    assert {via["status"] for via in run["vias"]} == {"served"}
    assert run["min_clearance_m"] is None or run["min_clearance_m"] >= required - 1e-9


def test_the_patrol_meets_what_is_not_on_its_map(tmp_path: Path) -> None:
    assert call("run", EXAMPLES / "fig8-patrol.yaml", "--out", tmp_path, "-q").exit_code == 0
    run = json.loads((tmp_path / "run.json").read_text())
    detected = [event["data"]["name"] for event in run["events"] if event["kind"] == "detected"]
    assert detected == ["crate", "fallen tree"]
    assert [replan["obstacles"] for replan in run["replans"]] == [["crate"], ["fallen tree"]]


@pytest.mark.parametrize("mission", ["fig7-obstacles.yaml", "fence-survey.plan"])
def test_the_detours_of_the_examples_take_the_shorter_side(mission: str, tmp_path: Path) -> None:
    assert call("plan", EXAMPLES / mission, "--out", tmp_path, "-q").exit_code == 0
    ledger = json.loads((tmp_path / "plan.json").read_text())["ledger"]
    assert ledger
    for entry in ledger:
        lengths = {c["side"]: c["length_m"] for c in entry["candidates"]}
        assert set(lengths) == {"left", "right"}
        assert entry["chosen"] == min(lengths, key=lengths.__getitem__)


def test_figures_are_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from viaspline.report import figures

    drawn = {name: (caption, lambda: b"png") for name, (caption, _) in figures.FIGURES.items()}
    monkeypatch.setattr(figures, "FIGURES", drawn)
    result = call("figures", "--out", tmp_path / "figs")
    assert result.exit_code == 0, result.stderr
    assert set(os.listdir(tmp_path / "figs")) == set(drawn)


@pytest.mark.skipif(os.name != "posix", reason="signals")
@pytest.mark.parametrize(
    ("sent", "code", "said"),
    [(signal.SIGINT, 130, "interrupted"), (signal.SIGTERM, 143, "terminated")],
)
@pytest.mark.parametrize("cold", [False, True])
def test_a_signal_ends_the_work_and_leaves_nothing(
    sent: signal.Signals, code: int, said: str, cold: bool, tmp_path: Path
) -> None:
    cache = {"VIASPLINE_CACHE_DIR": str(tmp_path / "cache")} if cold else {}
    job = process(
        "run", EXAMPLES / "fig8-patrol.yaml", "--out", "out", "--animate", "out/run.gif",
        cwd=tmp_path, env={**os.environ, **cache},
    )  # fmt: skip
    deadline = time.monotonic() + 300
    while not (tmp_path / "out").exists() and time.monotonic() < deadline:
        time.sleep(0.02)
    time.sleep(1.5)
    job.send_signal(sent)
    _, err = job.communicate(timeout=300)
    assert job.returncode == code, err
    assert f"viaspline: {said}; no file was left half written" in err
    assert "Traceback" not in err
    assert not (tmp_path / "out").exists()


def test_it_works_without_a_home_folder(clear: Path, tmp_path: Path) -> None:
    bare = {name: os.environ[name] for name in ("SYSTEMROOT", "TMPDIR") if name in os.environ}
    if CACHE_FOLDER is not None:  # it would compile all of a plan again
        bare["VIASPLINE_CACHE_DIR"] = str(CACHE_FOLDER.parent)
    job = process("plan", clear, "--out", "out", "--quiet", cwd=tmp_path, env=bare)
    out, _ = job.communicate(timeout=300)
    assert (job.returncode, out) == (0, "")
    assert set(os.listdir(tmp_path / "out")) == PLAN_FILES


@pytest.mark.skipif(os.name != "posix", reason="needs a shell")
def test_a_reader_that_goes_away_is_no_error(clear: Path, tmp_path: Path) -> None:
    command = f"{sys.executable} -m viaspline plan {clear} --out out; echo $? > code"
    done = subprocess.run(
        f"({command}) | true", shell=True, cwd=tmp_path, text=True, capture_output=True,
        timeout=300, check=False,
    )  # fmt: skip
    assert "Traceback" not in done.stderr
    assert "BrokenPipe" not in done.stderr
    assert (tmp_path / "code").read_text() == "0\n"


@pytest.mark.parametrize("arguments", [["--help"], ["check", EXAMPLES / "fig8-patrol.yaml"]])
def test_quick_commands_import_nothing_heavy(arguments: list[object]) -> None:
    code = (
        "import sys; from viaspline.cli import cli; "
        "cli(sys.argv[1:], standalone_mode=False); "
        "print(sorted({'numba', 'scipy', 'matplotlib', 'rich'} & set(sys.modules)))"
    )
    command = [sys.executable, "-c", code, *map(str, arguments)]
    done = subprocess.run(command, text=True, capture_output=True, timeout=60, check=True)
    assert done.stdout.splitlines()[-1] == "[]"
