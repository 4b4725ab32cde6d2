import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from viaspline import precompile
from viaspline.compile_fleets import drive_pair, timed_pair
from viaspline.fleet.plan_fleet import plan_fleet
from viaspline.kernels.kernel_cache import SOURCES
from viaspline.mission.fleet.fleet import Fleet

WHOLE = SOURCES.whole


def test_every_job_that_is_done_leaves_a_mark(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(precompile, "CACHE_FOLDER", tmp_path)
    precompile.compile_all(["curves"])
    assert {file.name for file in tmp_path.iterdir()} == {f"curves-{WHOLE}-compiled"}
    precompile.compile_all(["driving"])
    assert (tmp_path / f"driving-{WHOLE}-compiled").exists()


def test_the_second_process_is_started_once_and_ends_with_the_block(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    started: list[subprocess.Popen[bytes]] = []
    real = subprocess.Popen

    def recorded(*args: Any, **kwargs: Any) -> subprocess.Popen[bytes]:
        started.append(real(*args, **kwargs))
        return started[-1]

    monkeypatch.setattr(precompile, "CACHE_FOLDER", tmp_path)
    monkeypatch.setattr(precompile.os, "cpu_count", lambda: 2)
    monkeypatch.setattr(precompile.subprocess, "Popen", recorded)
    with precompile.second_compiler():
        assert len(started) == 1
    assert started[0].returncode is not None
    assert started[0].args[-1:] == ["curves"]  # type: ignore[index]
    (tmp_path / f"curves-{WHOLE}-compiled").touch()
    with precompile.second_compiler():
        assert len(started) == 1


def test_only_what_is_not_compiled_yet_is_asked_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[list[str]] = []

    def refuses(command: list[str], **kwargs: Any) -> None:
        asked.append(command[command.index("viaspline.precompile") + 1 :])
        raise FileNotFoundError("no interpreter")

    monkeypatch.setattr(precompile, "CACHE_FOLDER", tmp_path)
    monkeypatch.setattr(precompile.os, "cpu_count", lambda: 2)
    monkeypatch.setattr(precompile.subprocess, "Popen", refuses)
    for made in ("", f"curves-{WHOLE}-compiled"):
        (tmp_path / (made or "nothing")).touch()
        with precompile.second_compiler(["curves", "driving"]):
            pass
    assert asked == [["curves", "driving"], ["driving"]]


def test_without_an_interpreter_the_run_goes_on_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuses(*args: Any, **kwargs: Any) -> None:
        raise FileNotFoundError("no interpreter")

    monkeypatch.setattr(precompile, "CACHE_FOLDER", tmp_path)
    monkeypatch.setattr(precompile.os, "cpu_count", lambda: 2)
    monkeypatch.setattr(precompile.subprocess, "Popen", refuses)
    with precompile.second_compiler():
        pass


def test_the_kernels_of_fleets_are_compiled_by_two_robots_of_which_one_waits() -> None:
    pair = timed_pair()
    first, last = pair.courses.packed.first[:-1], pair.courses.packed.first[1:] - 1
    lasts = pair.laws.packed.arrive[last] - pair.laws.packed.leave[first]
    assert lasts.max() - lasts.min() > 0.1  # else nothing that slows a robot down was called
    assert (pair.crossings.packed.robots == [[0, 1]]).all()
    assert drive_pair()


def test_planning_a_small_fleet_needs_no_other_kernels_of_timing() -> None:
    timed_pair()
    kernels = {
        f"{module.__name__}.{name}": value
        for module in list(sys.modules.values())
        if module is not None and module.__name__.startswith("viaspline.kernels.fleet")
        for name, value in vars(module).items()
        if hasattr(value, "signatures") and value.signatures
    }
    before = {name: len(one.signatures) for name, one in kernels.items()}
    plan_fleet(crossing_fleet())
    compiled = [name for name, one in kernels.items() if len(one.signatures) > before[name]]
    assert not compiled


def test_a_fleet_asks_for_what_its_robots_need_and_for_what_times_them() -> None:
    fleet = crossing_fleet()
    assert precompile.jobs_of(fleet) == ("curves", "fleets")
    assert precompile.jobs_of(fleet, drives=True) == ("curves", "fleets", "fleet_drives")
    turning = crossing_fleet(min_turn_radius_m=1.0)
    assert precompile.jobs_of(turning) == ("curves", "fleets", "driving")
    assert precompile.jobs_of(fleet.members[0].mission, drives=True) == ("curves",)


def crossing_fleet(**robot: float) -> Fleet:
    routes = {"a": ([0, 0], [40, 0]), "b": ([20, -20], [20, 20])}
    fleet = [{"name": n, "route": {"start": s, "goal": g}} for n, (s, g) in routes.items()]
    return Fleet.model_validate(
        {"robots": {"cart": {"radius_m": 0.4, **robot}}, "separation_m": 1, "fleet": fleet}
    )
