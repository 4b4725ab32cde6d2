"""The first run on a machine: a second process compiles half of the kernels meanwhile.

Compiling is most of a first run and numba does it on one core. The kernels of curves and of the
time law need none of those of the world; so while a run begins with the latter, another process
(``python -m viaspline.precompile``) compiles the former into the same cache. For a robot with a
turning circle, a body or a drive it goes on with what such a robot needs at the end of its plan;
for a fleet with what times its robots, proves them apart and drives them.
"""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Final, Literal

from viaspline.kernels.kernel_cache import CACHE_FOLDER, SOURCES
from viaspline.kernels.shipped_kernels import SHIPPED
from viaspline.mission.robot_parts import RobotSpec
from viaspline.report.terminal.interrupts import undone_at_the_end

if TYPE_CHECKING:
    from viaspline.mission.fleet.fleet import Fleet
    from viaspline.mission.model import Mission

Job = Literal["curves", "fleets", "fleet_drives", "driving"]
LOCK_NAME = "compiling"
MAX_LOCK_AGE_S = 300.0  # a lock that is older than this was left behind [s]


def compile_curves() -> None:
    """Call every kernel of curves and of the time law once, as a run does."""
    from viaspline.curve.path import Path
    from viaspline.machine.measure_drivability import drivability_of
    from viaspline.mission.robot_parts import RobotSpec
    from viaspline.trajectory.limits import Limits, Station
    from viaspline.trajectory.retime import retime
    from viaspline.world.world import World

    path = Path([[[0, 0], [1, 0], [2, 1], [3, 1]], [[3, 1], [4, 1], [5, 0], [6, 2]]], vias=[])
    limits = Limits(max_speed=2.0, max_accel=1.0, max_lateral_accel=0.5)
    trajectory = retime(path, limits, [Station(2.0, 1.0)])
    drivability_of(path, trajectory, RobotSpec(radius_m=9.0), World([]))
    u, _, _ = path.sample(1.0)
    path.heading(u)
    path.curvature(u)
    path.max_curvature()
    path.section(0.2, 1.5)
    path.project((1.0, 1.0))


def compile_driving() -> None:
    """Call the kernels of trial drives, of the search among poses, of turns and of bodies once.

    In this order: a run that compiles as well comes to the last of them first.
    """
    import numpy as np

    from viaspline.curve.bending import curvature_bound
    from viaspline.curve.piecewise import PiecewiseCubic
    from viaspline.machine.allowance import allowance_on_bends
    from viaspline.mission.model import Mission
    from viaspline.planning.checking.conflicts import is_clear, proven
    from viaspline.planning.problem.requirements import Requirements
    from viaspline.planning.problem.via_sequence import via_sequence_of
    from viaspline.planning.problem.work_budget import WorkBudget
    from viaspline.planning.turning.bend_row import Bends, bend
    from viaspline.planning.turning.hybrid_astar.via_route import via_route_chains
    from viaspline.planning.turning.turn_path import RAMP, TurnPath, turn_path_round
    from viaspline.world.world import World

    mission = Mission.model_validate(
        {
            "world": {"known": [{"polygon": [[4, 0], [5, -0.5], [6, 0]]}]},
            "robot": {
                "footprint": [[-0.3, -0.4], [1, -0.4], [1, 0.4], [-0.3, 0.4]],
                "clearance_m": 0.1,
                "drive": {"ackermann": {"wheelbase_m": 1.0, "max_steer_deg": 35}},
            },
            "route": {"start": [0, 0.2], "goal": [12, 3]},
        }
    )
    world, requirements, circle = World.known(mission), Requirements.of(mission), 2.0
    allowance_on_bends(mission.robot, circle)
    via_route_chains(
        via_sequence_of(mission), world, requirements, circle, RAMP * circle, (), WorkBudget(1.0)
    )
    rows = [bend(0, 0), bend(6, 3, 1.0, 1.0), bend(12, 0)]
    turn_path = turn_path_round(Bends.free(np.array(rows), np.array([0, -1, 1])).turning(circle))
    assert isinstance(turn_path, TurnPath)
    curve = PiecewiseCubic(turn_path.spans)
    curvature_bound(curve)
    is_clear(world, turn_path.spans, requirements)
    proven(curve, world, requirements)


def compile_fleets() -> None:
    """Time two robots that cross, and prove them apart, once."""
    from viaspline.compile_fleets import timed_pair

    timed_pair()


def compile_fleet_drives() -> None:
    """Drive two robots that cross, once."""
    from viaspline.compile_fleets import drive_pair

    drive_pair()


JOBS: Final[Mapping[Job, Callable[[], None]]] = {
    "curves": compile_curves,
    "fleets": compile_fleets,
    "fleet_drives": compile_fleet_drives,
    "driving": compile_driving,
}


def jobs_for(robot: RobotSpec) -> tuple[Job, ...]:
    """What the first run of a robot has compiled for it.

    >>> jobs_for(RobotSpec(radius_m=0.4)), jobs_for(RobotSpec(min_turn_radius_m=2))
    (('curves',), ('curves', 'driving'))
    """
    parts = (robot.footprint, robot.turn_radius, robot.drive, robot.localization)
    return ("curves",) if all(part is None for part in parts) else ("curves", "driving")


def jobs_of(asked: Mission | Fleet, *, drives: bool = False) -> tuple[Job, ...]:
    """What the first run of a mission or of a fleet has compiled for it.

    Args:
        asked: What is planned.
        drives: Whether it is driven as well.
    """
    from viaspline.mission.model import Mission

    if isinstance(asked, Mission):
        return jobs_for(asked.robot)
    needed = {job for one in asked.members for job in jobs_for(one.mission.robot)} | {"fleets"}
    if drives:
        needed.add("fleet_drives")
    return tuple(job for job in JOBS if job in needed)


def compile_all(jobs: Sequence[Job]) -> None:
    """Do the jobs, each with a mark when it is done."""
    for job in jobs:
        JOBS[job]()
        if CACHE_FOLDER is not None:
            _mark(job).touch()


def mark_name(job: Job) -> str:
    """The name of the file that says that a job was done, with the kernels as they are."""
    return f"{job}-{SOURCES.whole}-compiled"


def _mark(job: Job) -> Path:
    assert CACHE_FOLDER is not None
    return CACHE_FOLDER / mark_name(job)


def _is_done(job: Job) -> bool:
    """Whether a job was done here, or by who made the wheel."""
    is_shipped = SHIPPED is not None and (SHIPPED.folder / mark_name(job)).exists()
    return is_shipped or _mark(job).exists()


def _taken() -> bool:
    """Take the job: one helper is enough, however many first runs begin at once."""
    assert CACHE_FOLDER is not None
    lock = CACHE_FOLDER / LOCK_NAME
    with suppress(OSError):
        if time.time() - lock.stat().st_mtime > MAX_LOCK_AGE_S:
            lock.unlink()
    try:
        lock.touch(exist_ok=False)
    except OSError:
        return False
    return True


def _release() -> None:
    assert CACHE_FOLDER is not None
    with suppress(OSError):
        (CACHE_FOLDER / LOCK_NAME).unlink()


@contextmanager
def second_compiler(jobs: Sequence[Job] = ("curves",)) -> Iterator[None]:
    """Within the block another process compiles what is not yet, if there is a core for it.

    Args:
        jobs: What this run will need.
    """
    cores = os.cpu_count() or 1
    left = [] if CACHE_FOLDER is None else [job for job in jobs if not _is_done(job)]
    if CACHE_FOLDER is None or not left or cores < 2 or not _taken():
        yield
        return
    try:
        process = subprocess.Popen(
            [sys.executable, "-P", "-m", "viaspline.precompile", *left],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
    except OSError:  # no interpreter of its own, as in a frozen program: the run compiles all
        _release()
        yield
        return

    def end() -> None:
        process.kill()
        process.wait()
        _release()

    try:
        with undone_at_the_end(end):
            yield
    finally:
        end()


if __name__ == "__main__":
    compile_all([job for job in JOBS if job in sys.argv[1:]])
