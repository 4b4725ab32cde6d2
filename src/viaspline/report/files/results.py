"""Everything that a plan or a run leaves in its folder.

Tested through ``report/files/test_result_files``.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from viaspline.formats.mission_yaml import yaml_text
from viaspline.mission.model import Mission
from viaspline.planner import Plan
from viaspline.report.files.csv_tables import path_csv, run_csv, spacing
from viaspline.report.files.plan_json import plan_json
from viaspline.report.files.result_files import ResultFolder
from viaspline.report.files.run_json import run_json, timing_json
from viaspline.report.plan_picture import plan_picture
from viaspline.report.run_picture import run_picture
from viaspline.robot.run import Run

TIMING_FILE = "timing.json"
MISSION_FILE = "planned-mission.yaml"

Contents = dict[str, bytes | str]


def path_contents(plan: Plan, name: str) -> Contents:
    """The files of a plan without its picture: the same bytes every time."""
    return {
        "plan.json": plan_json(plan, name, spacing=spacing(plan.path.length)),
        "path.csv": path_csv(plan),
    }


def plan_contents(plan: Plan, name: str) -> Contents:
    """The files of a plan: the same bytes every time."""
    return {**path_contents(plan, name), "plan.png": plan_picture(plan, name)}


def mission_contents(mission: Mission, folder: Path) -> Contents:
    """The mission as it was planned, beside its plan, which is read again with it.

    Its via points are in the order in which they are served, and its tension is a number, or none.

    Args:
        mission: That of a plan.
        folder: Where it is going to stand.

    Raises:
        OutputError: It has a map that was made in memory.
    """
    return {MISSION_FILE: yaml_text(mission, folder)}


def run_contents(run: Run, name: str, *, seed: int = 0) -> Contents:
    """The files of a run, without those of its plan."""
    return {
        "run.json": run_json(run, name, seed=seed),
        "run.csv": run_csv(run),
        "run.png": run_picture(run, name),
    }


def write_all(
    folder: ResultFolder, contents: Contents, stages: Mapping[str, float], run: Run | None = None
) -> list[Path]:
    """Write every file when all are there, so that old and new ones are not mixed.

    Args:
        folder: Where to.
        contents: The files.
        stages: Wall-clock time of every stage, for ``timing.json`` [s].
        run: For the times of its re-plans.

    Returns:
        The paths of the files.
    """
    timing = timing_json(stages, run.compute_times if run is not None else ())
    everything = {**contents, TIMING_FILE: timing}
    return [folder.write(name, content) for name, content in everything.items()]
