"""Everything that the plan of a fleet leaves in its folder, and a folder for each robot."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Final

from viaspline.errors import OutputError
from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.saved.course_record import CourseRecord
from viaspline.fleet.saved.load_fleet_plan import (
    COURSES_NAME,
    PLANNED_FLEET_NAME,
)
from viaspline.formats.fleet_yaml import fleet_text
from viaspline.mission.fleet.fleet import Fleet
from viaspline.planner import Plan
from viaspline.report.earlier_robots import forget_robots
from viaspline.report.files.fleet_json import fleet_json
from viaspline.report.files.fleet_run_json import fleet_run_json
from viaspline.report.files.result_files import ResultFolder
from viaspline.report.files.results import Contents, path_contents
from viaspline.report.fleet.fleet_picture import fleet_picture
from viaspline.report.fleet.fleet_run_picture import fleet_run_picture
from viaspline.report.space.spatial_results import spatial_path_contents
from viaspline.saved_plans.load_plan import FLEET_NAME
from viaspline.space.spatial_plan import SpatialPlan

FLEET_FILES: Final = (
    FLEET_NAME, "fleet.png", COURSES_NAME, PLANNED_FLEET_NAME, "timing.json"
)  # fmt: skip
"""What is written for a fleet as a whole."""
FLEET_RUN_FILES: Final = (*FLEET_FILES, "run.json", "run.png")
"""What is written for a fleet that was driven."""
ROBOT_FILES: Final = ("plan.json", "path.csv")
"""What is written for each robot that is served."""

_OWN_NAMES: Final = frozenset({*FLEET_RUN_FILES, "run.csv"})
_UNSAFE: Final = re.compile(r"[^\w.-]+")
_LONGEST_NAME: Final = 60


def folder_names(robots: Iterable[str]) -> dict[str, str]:
    """A name for the folder of each robot: its own, as far as every file system takes it.

    No two are told apart by capitals alone, and none is called as a file of the fleet.

    >>> folder_names(["r1", "R1", "cart 2/3", "..", "fleet.json"])
    {'r1': 'r1', 'R1': 'R1-2', 'cart 2/3': 'cart_2_3', '..': 'robot', 'fleet.json': 'fleet.json-2'}
    """
    taken = set(_OWN_NAMES)
    names: dict[str, str] = {}
    for robot in robots:
        plain = _UNSAFE.sub("_", robot)[:_LONGEST_NAME].strip(". ") or "robot"
        name, number = plain, 1
        while name.casefold() in taken:
            number += 1
            name = f"{plain}-{number}"
        taken.add(name.casefold())
        names[robot] = name
    return names


def fleet_contents(plan: FleetPlan, name: str) -> Contents:
    """The files of a fleet as a whole: the same bytes every time."""
    folders = folder_names(one.name for one in plan.fleet.members)
    return {
        FLEET_NAME: fleet_json(plan, name, folders),
        "fleet.png": fleet_picture(plan, name),
        COURSES_NAME: CourseRecord.of(plan).to_bytes(),
    }


def planned_fleet_contents(fleet: Fleet, folder: Path) -> Contents:
    """The fleet as it was asked for, beside its plan, which is read again with it.

    Args:
        fleet: That of a plan.
        folder: Where it is going to stand.

    Raises:
        OutputError: It has a map or a robot's mission that was made in memory.
    """
    return {PLANNED_FLEET_NAME: fleet_text(fleet, folder)}


def fleet_run_contents(plan: FleetPlan, run: FleetRun, name: str, *, seed: int) -> Contents:
    """The files of a drive of a fleet, without those of its plan: the same bytes every time."""
    return {
        "run.json": fleet_run_json(run, name, seed=seed),
        "run.png": fleet_run_picture(plan, run, name),
    }


def check_robot_folders(path: Path, robots: Iterable[str]) -> None:
    """See before the work whether there can be a folder for each robot.

    Raises:
        OutputError: A file has the name of one.
    """
    for name in folder_names(robots).values():
        if (path / name).exists() and not (path / name).is_dir():
            raise OutputError(path / name, "is a file where a folder has to go; move it away")


def write_robots(plan: FleetPlan, path: Path, progress: Callable[[float], None]) -> list[Path]:
    """Write the files of every robot that is served, each into its own folder.

    They are made one robot after the other: those of ten thousand don't fit into memory at once.

    Args:
        plan: What was planned.
        path: The folder of the fleet.
        progress: Called with the share of robots that are written.

    Returns:
        The folders.

    Raises:
        OutputError: A file can't be written.
    """
    names = folder_names(one.name for one in plan.fleet.members)
    folders = []
    for i, (robot, planned) in enumerate(plan.plans.items()):
        progress(i / len(plan.plans))
        folder = ResultFolder(path / names[robot], ROBOT_FILES)
        for file, content in robot_contents(planned, robot).items():
            folder.write(file, content)
        folders.append(folder.path)
    return folders


def robot_contents(planned: Plan | SpatialPlan, robot: str) -> Contents:
    """The files of one robot of a fleet, by name.

    Args:
        planned: Its plan.
        robot: What it is called.
    """
    if isinstance(planned, SpatialPlan):
        return spatial_path_contents(planned, robot)
    return path_contents(planned, robot)


def forget_earlier(path: Path, earlier: Iterable[str], written: Iterable[Path]) -> list[str]:
    """Remove what an earlier run wrote for robots for which nothing was written now.

    Args:
        path: The folder of the fleet.
        earlier: The folders of its robots, as they were before anything was written.
        written: The folders of robots that were written now.

    Returns:
        The names of those that were removed.
    """
    kept = {folder.name.casefold() for folder in written}
    gone = [name for name in earlier if name.casefold() not in kept]
    return forget_robots(path, gone, ROBOT_FILES)
