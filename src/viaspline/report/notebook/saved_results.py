"""What ``plan.save(folder)`` and its like write: the files that the command line writes."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Final

from viaspline.caller_warning import warn_caller
from viaspline.errors import OutputError, with_article
from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.saved.load_fleet_plan import PLANNED_FLEET_NAME
from viaspline.handed_in import check_kind
from viaspline.mission.fleet.fleet import Fleet
from viaspline.mission.model import Mission
from viaspline.planner import Plan
from viaspline.presentable.upper_doors import opened, opened_for
from viaspline.report.files.fleet_results import (
    check_robot_folders,
    fleet_contents,
    planned_fleet_contents,
    write_robots,
)
from viaspline.report.files.fleet_run_json import fleet_run_json
from viaspline.report.files.result_files import ResultFolder
from viaspline.report.files.results import (
    MISSION_FILE,
    Contents,
    mission_contents,
    plan_contents,
    run_contents,
)
from viaspline.report.space.spatial_results import spatial_plan_contents, spatial_run_contents
from viaspline.robot.run import Run
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_run import SpatialRun

SINGLE_FILES: Final = frozenset(
    {
        ".plan",
        ".waypoints",
        ".geojson",
        ".kml",
        ".gpx",
        ".csv",
        ".json",
        ".txt",
        ".yaml",
        ".yml",
        ".mcap",
    }
)
"""Endings of files that are written alone: what an autopilot or a map takes."""
MISSION: Final = "mission"
"""What a mission is called of which nothing else is said,"""
FLEET: Final = "fleet"
"""and a fleet."""


def save(
    value: object,
    path: str | Path,
    name: str | None = None,
    origin: tuple[float, float] | None = None,
) -> list[Path]:
    """Write a plan or a run.

    Args:
        value: It.
        path: The folder, which is made if it isn't there. With one of the endings of
            ``SINGLE_FILES`` it is a file, which the exports write.
        name: What the mission is called; None: ``MISSION`` or ``FLEET``, and in a single file what
            that is called. It isn't taken from the folder: the same plan gives the same bytes.
        origin: Latitude and longitude of the mission's 0, 0 [deg], for files that have them. None:
            as the mission says.

    Returns:
        What was written.

    Raises:
        OutputError: It can't be written, or there is nobody who writes such a file.
        GeometryError: ``path`` is no path, or ``name`` no text.

    Warns:
        MissionWarning: The mission has a map that was made in memory, so that it can't be a file.
    """
    check_kind("path", path, (str, Path), "give the path of a folder")
    if name is not None:
        check_kind("name", name, str, "give a text")
    target = Path(path)
    if target.suffix.lower() in SINGLE_FILES and not target.is_dir():
        return _exported(value, target, name, origin)
    found: list[Path] = opened_for("files", value)(value, target, name)
    return found


def _exported(
    value: object, target: Path, name: str | None, origin: tuple[float, float] | None
) -> list[Path]:
    """What the exports write into a file of their own."""
    if not isinstance(value, Plan | SpatialPlan):
        kind = type(value).__name__
        raise OutputError(
            target, f"{with_article(kind)} isn't written as such a file; give a folder"
        )
    opened("export")(value, target, name=name, origin=origin)
    return [target]


def plan_files(plan: Plan, folder: Path, name: str | None) -> list[Path]:
    """Those of ``viaspline plan`` but for the wall clock's."""
    return _written(
        folder, plan_contents(plan, name or MISSION) | _mission_in(folder, plan.mission)
    )


def spatial_plan_files(plan: SpatialPlan, folder: Path, name: str | None) -> list[Path]:
    """Those of ``viaspline plan`` but for the wall clock's."""
    contents = spatial_plan_contents(plan, name or MISSION)
    return _written(folder, contents | _mission_in(folder, plan.mission))


def fleet_plan_files(plan: FleetPlan, folder: Path, name: str | None) -> list[Path]:
    """Those of ``viaspline plan`` but for the wall clock's, with a folder for each robot."""
    check_robot_folders(folder, (one.name for one in plan.fleet.members))
    contents = fleet_contents(plan, name or FLEET)
    files = _written(folder, contents | _fleet_in(folder, plan.fleet))
    return files + write_robots(plan, folder, lambda share: None)


def run_files(run: Run, folder: Path, name: str | None) -> list[Path]:
    """Those of ``viaspline run`` but for the wall clock's: of the run and of its plan."""
    name = name or MISSION
    contents = plan_contents(run.plan, name) | _mission_in(folder, run.plan.mission)
    return _written(folder, contents | run_contents(run, name))


def spatial_run_files(run: SpatialRun, folder: Path, name: str | None) -> list[Path]:
    """Those of ``viaspline run`` but for the wall clock's: of the flight and of its plan."""
    name = name or MISSION
    contents = spatial_plan_contents(run.plan, name) | _mission_in(folder, run.plan.mission)
    return _written(folder, contents | spatial_run_contents(run, name))


def fleet_run_files(run: FleetRun, folder: Path, name: str | None) -> list[Path]:
    """``run.json``; its picture is one of the plan as well, which a run doesn't hold."""
    return _written(folder, {"run.json": fleet_run_json(run, name or FLEET)})


def _mission_in(folder: Path, mission: Mission) -> Contents:
    """The mission as it was planned; a map that was made in memory can't be in a file."""
    remedy = "keep the mission, and give it to load_plan"
    return _beside(folder / MISSION_FILE, lambda: mission_contents(mission, folder), remedy)


def _fleet_in(folder: Path, fleet: Fleet) -> Contents:
    """The fleet that was planned; what was made in memory can't be in a file."""
    remedy = "keep the fleet, and give it to load_fleet_plan"
    return _beside(
        folder / PLANNED_FLEET_NAME, lambda: planned_fleet_contents(fleet, folder), remedy
    )


def _beside(file: Path, contents: Callable[[], Contents], remedy: str) -> Contents:
    """What stands beside a plan to read it again; none, with a warning, if it can't be written."""
    try:
        return contents()
    except OutputError as error:
        words = f"{file} isn't written: {error}; {remedy}"
        warn_caller(words)
        with suppress(OSError):
            file.unlink(missing_ok=True)  # that of an earlier plan isn't this one's
        return {}


def _written(folder: Path, contents: Contents) -> list[Path]:
    """All files, when all of them are there."""
    target = ResultFolder(folder, contents)
    return [target.write(name, content) for name, content in contents.items()]
