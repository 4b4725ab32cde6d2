import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

import viaspline as vs
from viaspline.kernels import kernel_cache
from viaspline.kernels.loaded_kernels import LoadedKernel
from viaspline.warming import compile_apart as apart
from viaspline.warming import warm_up as module
from viaspline.warming.kernel_list import KernelList
from viaspline.warming.mission_kind import PARTS, MissionKind, kinds_of
from viaspline.warming.small_missions import OF_PART, missions_of
from viaspline.warming.warm_everything import warm_everything

compiled = pytest.mark.skipif(
    os.environ.get("NUMBA_DISABLE_JIT") == "1", reason="nothing is compiled with the JIT off"
)
STEP_WAITS = Path(__file__).with_name("step_waits.py")
MISSION = vs.Mission.model_validate({"route": {"start": [0, 0], "goal": [9, 0]}})
PLAIN, LIDAR = MissionKind(), MissionKind(("lidar",))


@compiled
@pytest.mark.parametrize(
    "kind",
    [
        "untold",
        pytest.param("lidar+ackermann+footprint+turning", marks=pytest.mark.slow),
        pytest.param("differential", marks=pytest.mark.slow),
    ],
)
def test_no_step_compiles_loads_or_imports_anything(kind: str) -> None:
    """All sensors, drives and bodies with each other: ``step_waits.py --every``."""
    command = [sys.executable, "-W", "ignore", STEP_WAITS, kind]
    done = subprocess.run(command, text=True, capture_output=True, timeout=900, check=False)
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    assert told["steps"] > 300
    assert sum(replans for _, replans in told["outcomes"]) > 2
    assert [told["compiled"], told["loaded"], told["imported"]] == [[], [], []]


def test_every_part_of_a_kind_is_met_in_its_small_missions() -> None:
    for part in PARTS:
        kind = MissionKind((part,))
        if part == "space":
            continue
        found = {found for _, mission in missions_of(kind) for one in kinds_of(mission)
                 for found in one.parts}  # fmt: skip
        assert part in found, part
        assert part in OF_PART or part in ("map", "moving", "laps", "corridor", "zones")


class Apart:
    """Other processes that are not there: what they would have done is written down."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, lists: bool) -> None:
        self.asked: list[str] = []
        self.listed: set[MissionKind] = set()
        self.recorded: list[MissionKind] = []
        monkeypatch.setattr(module, "compile_apart", self.compile)
        monkeypatch.setattr(KernelList, "read", self.read)
        monkeypatch.setattr("viaspline.warming.record_kind.record", self.record)
        self.lists = lists

    def compile(self, kind: MissionKind, tell: Any) -> bool:
        self.asked.append(kind.name)
        tell("a.kernel")
        if self.lists:
            self.listed.add(kind)
        return self.lists

    def read(self, kind: MissionKind, key: str) -> KernelList | None:
        return KernelList(("json",), ()) if kind in self.listed else None

    def record(self, kind: MissionKind, tell: Any, jobs: Any) -> None:
        self.recorded.append(kind)


@compiled
def test_what_is_on_a_list_is_loaded_and_what_has_none_is_compiled_apart(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    others, heard = Apart(monkeypatch, lists=True), list[str]()
    module.warm_up(MISSION, heard.append)
    assert (others.asked, heard, others.recorded) == (["plain"], ["a.kernel"], [])
    module.warm_up(MISSION, heard.append)
    assert others.asked == ["plain"]


@compiled
def test_without_another_process_this_one_drives(monkeypatch: pytest.MonkeyPatch) -> None:
    others = Apart(monkeypatch, lists=False)
    module.warm_up(MISSION)
    assert others.recorded == [PLAIN]


def test_a_list_is_read_as_it_was_written_and_only_for_its_sources(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(kernel_cache, "CACHE_FOLDER", tmp_path)
    monkeypatch.setattr(kernel_cache, "SHIPPED", None)
    one = KernelList(("viaspline.errors",), (LoadedKernel("a.b", "c", "(float64,)"),))
    one.write(LIDAR, "key")
    assert KernelList.read(LIDAR, "key") == one
    assert KernelList.read(LIDAR, "other") is None
    assert KernelList.read(PLAIN, "key") is None
    for file in (tmp_path / "lists").iterdir():
        file.write_text("{}")
    assert KernelList.read(LIDAR, "key") is None
    monkeypatch.setattr(kernel_cache, "CACHE_FOLDER", None)
    one.write(LIDAR, "key")
    assert KernelList.read(LIDAR, "key") is None


def test_a_kernel_that_nobody_compiled_is_said_to_be_missing() -> None:
    gone = LoadedKernel("viaspline.kernels.heap", "no_such_kernel", "()")
    assert KernelList((), (gone,)).load() == (gone,)


def test_a_process_that_fails_is_told_of_and_the_others_go_on(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def compile_one(kind: MissionKind, tell: Any, *how: str) -> bool:
        assert how == ("alone",)
        return kind != LIDAR

    monkeypatch.setattr("viaspline.warming.warm_everything.compile_apart", compile_one)
    done: list[tuple[str, bool]] = []
    kinds = (PLAIN, LIDAR, MissionKind(("map",)))
    warm_everything(kinds, print, lambda kind, took, worked: done.append((kind.name, worked)))
    assert sorted(done) == [("lidar", False), ("map", True), ("plain", True)]


def test_without_a_cache_or_an_interpreter_nothing_is_compiled_apart(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(apart, "CACHE_FOLDER", None)
    assert not apart.compile_apart(PLAIN, print)
    monkeypatch.setattr(apart, "CACHE_FOLDER", tmp_path)
    monkeypatch.setattr(apart.sys, "executable", str(tmp_path / "gone"))
    assert not apart.compile_apart(PLAIN, print)


def test_another_process_says_what_it_compiles_and_ends(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    said = tmp_path / "python"
    said.write_text("#!/bin/sh\necho $2 $3 $4 $5\necho disc.conflicts\nexit 3\n")
    said.chmod(0o700)
    monkeypatch.setattr(apart, "CACHE_FOLDER", tmp_path)
    monkeypatch.setattr(apart.sys, "executable", str(said))
    heard: list[str] = []
    assert not apart.compile_apart(LIDAR, heard.append, "alone")
    assert heard == ["-m viaspline.warming.record_kind lidar alone", "disc.conflicts"]


def test_a_navigator_warms_up_unless_it_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[Any] = []
    stub = type("Stub", (), {"warm_up": staticmethod(lambda *given: asked.append(given))})
    monkeypatch.setattr("viaspline.robot.warmed.import_module", lambda home: stub)
    nav = vs.Navigator(MISSION, warm=False)
    assert not asked
    nav.warm(print)
    vs.Navigator(MISSION, progress=print)
    assert asked == [(MISSION, print), (MISSION, print)]
    fleet = vs.Fleet.of([vs.FleetMember("a", MISSION)])
    plan = vs.plan_fleet(fleet)
    vs.FleetNavigator(plan)
    vs.FleetNavigator(plan, warm=False)
    assert asked[2:] == [(plan.fleet, None)]
