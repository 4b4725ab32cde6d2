"""The bytes of paths don't depend on who lays them, nor on who dies meanwhile."""

from __future__ import annotations

import gc
import multiprocessing
import os
import signal
import sys
from collections.abc import Callable
from typing import Any

import pytest

from viaspline.errors import GeometryError, WorkersError
from viaspline.fleet.laying.chosen_workers import (
    ROBOTS_SAVED,
    cluster_workers,
    local_workers,
    usual_count,
)
from viaspline.fleet.laying.lay_paths import LaidPaths, lay_paths
from viaspline.fleet.laying.laying_workers import Cluster, Processes, ThisProcess
from viaspline.mission.fleet.fleet import Fleet


def row(count: int) -> Fleet:
    """Robots side by side whose straight ways cross, past each other's resting places."""
    return Fleet.model_validate({
        "separation_m": 1,
        "spline": {"tension": 0.0},
        "fleet": [
            {"name": f"r{k}", "route": {"start": [4 * k, 0], "goal": [50 - 4 * k, 20 + 3 * k]}}
            for k in range(count)
        ],
    })  # fmt: skip


def fingerprint(found: LaidPaths) -> list[tuple[str, bytes, bytes]]:
    return [
        (name, plan.path.spans.tobytes(), plan.trajectory.times.tobytes())
        for name, plan in found.plans.items()
    ]


@pytest.fixture(scope="module")
def fleet() -> Fleet:
    return row(10)


@pytest.fixture(scope="module")
def here(fleet: Fleet) -> list[tuple[str, bytes, bytes]]:
    found = fingerprint(lay_paths(fleet))
    assert len(found) == 10
    return found


def one_killed(kill: Callable[[], None]) -> tuple[Callable[[int, int], None], list[int]]:
    """Progress that kills once something is done, and when it did."""
    killed: list[int] = []

    def heard(done: int, of: int) -> None:
        if not killed:
            killed.append(done)
            kill()

    return heard, killed


@pytest.mark.slow
@pytest.mark.parametrize("count", [1, 3])
def test_bytes_do_not_depend_on_processes_one_of_which_is_killed(
    fleet: Fleet, here: list[tuple[str, bytes, bytes]], count: int
) -> None:
    known = set(multiprocessing.active_children())

    def kill() -> None:
        ours = sorted(set(multiprocessing.active_children()) - known, key=lambda one: one.pid or 0)
        ours[0].kill()

    heard, killed = one_killed(kill)
    with Processes(count) as workers:
        there = fingerprint(lay_paths(fleet, heard, workers=workers))
    assert killed[0] < 2 * 10  # work was left
    assert there == here


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_bytes_do_not_depend_on_a_cluster_of_three_one_of_which_is_killed(
    fleet: Fleet, here: list[tuple[str, bytes, bytes]]
) -> None:
    distributed: Any = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=3, threads_per_worker=1, dashboard_address=None
    ) as cluster:
        heard, killed = one_killed(lambda: cluster.workers[0].process.process.kill())
        with cluster_workers(cluster.scheduler_address) as workers:
            assert isinstance(workers, Cluster)
            there = fingerprint(lay_paths(fleet, heard, workers=workers))
    assert killed[0] < 2 * 10
    assert there == here


def dies(_: int) -> int:
    os.kill(os.getpid(), signal.SIGKILL)
    return 0


@pytest.mark.slow
def test_work_that_kills_whoever_does_it_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("viaspline.fleet.laying.laying_workers.MAX_DEATHS", 1)
    with Processes(1) as workers, pytest.raises(WorkersError, match="2 processes died") as told:
        list(workers.each(dies, [0]))
    assert "fewer workers" in str(told.value)


@pytest.mark.parametrize("count", [0, -1, 2.5, "two"])
def test_what_is_no_number_of_processes_is_refused(count: Any) -> None:
    with pytest.raises(GeometryError, match="number of processes"):
        Processes(count)


def test_small_fleets_are_laid_here_and_large_ones_by_all_cores(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("os.sched_getaffinity", lambda _: {0, 1}, raising=False)
    assert [usual_count(n) for n in (1, 2 * ROBOTS_SAVED - 2, 2 * ROBOTS_SAVED)] == [1, 1, 2]
    monkeypatch.setattr("os.sched_getaffinity", lambda _: {0}, raising=False)
    assert usual_count(100_000) == 1
    with local_workers(1) as workers:
        assert isinstance(workers, ThisProcess)


def test_without_distributed_it_is_said_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with (
        pytest.raises(WorkersError, match=r'pip install "viaspline\[cluster\]"'),
        cluster_workers("tcp://127.0.0.1:8786"),
    ):
        pass


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("address", ["tcp://127.0.0.1:1", "nowhere at all", "zz://a:1"])
def test_where_no_scheduler_answers_it_is_said_so(
    monkeypatch: pytest.MonkeyPatch, address: str
) -> None:
    distributed = pytest.importorskip("distributed")
    monkeypatch.setattr("viaspline.fleet.laying.chosen_workers.CONNECT_S", 0.5)
    with pytest.raises(WorkersError, match="no scheduler"), cluster_workers(address):
        pass
    clients = [one for one in gc.get_objects() if type(one) is distributed.Client]
    assert {one.status for one in clients} <= {"closed"}  # else the next one might wait for ever
