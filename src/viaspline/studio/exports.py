"""What the page can take away: the very files that the command line writes.

Tested through ``studio/test_server_files``.
"""

from __future__ import annotations

from typing import Final, TypeAlias

from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.planner import Plan
from viaspline.report.csv_tables import path_csv, run_csv, spacing
from viaspline.report.plan_json import plan_json
from viaspline.report.run_json import run_json
from viaspline.report.space.spatial_results import spatial_plan_contents, spatial_run_contents
from viaspline.robot.run import Run
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_run import SpatialRun
from viaspline.studio.fleet.simulated_fleet import (
    FLEET_FILES,
    SimulatedFleet,
    fleet_file,
    fleet_run_file,
)
from viaspline.studio.refused_error import RefusedError

PLAN_FILES: Final = ("plan.json", "path.csv", "plan.png")
RUN_FILES: Final = ("run.json", "run.csv", "run.png")


AnyPlan: TypeAlias = Plan | FleetPlan | SpatialPlan
AnyRun: TypeAlias = Run | SimulatedFleet | SpatialRun


def plan_file(plan: AnyPlan, kind: str, name: str) -> bytes:
    """One of the files of a plan.

    Args:
        plan: The plan.
        kind: ``plan.json``, ``path.csv`` or ``plan.png``; of a fleet's ``fleet.json`` or
            ``fleet.png``.
        name: The mission's name.
    """
    if isinstance(plan, FleetPlan):
        return fleet_file(plan, kind, name)
    if isinstance(plan, SpatialPlan):
        content = spatial_plan_contents(plan, name)[kind]
        return content.encode() if isinstance(content, str) else content
    if kind == "plan.json":
        return plan_json(plan, name, spacing=spacing(plan.path.length)).encode()
    if kind == "path.csv":
        return path_csv(plan).encode()
    from viaspline.report.plan_picture import plan_picture

    return plan_picture(plan, name)


def run_file(run: AnyRun, kind: str, name: str, seed: int) -> bytes:
    """One of the files of a run: ``run.json``, ``run.png``, and of one robot ``run.csv``."""
    if isinstance(run, SimulatedFleet):
        return fleet_run_file(run, kind, name, seed)
    if isinstance(run, SpatialRun):
        contents = spatial_run_contents(run, name)
        if kind not in contents:
            raise RefusedError(f"a flight has {' and '.join(contents)}")
        content = contents[kind]
        return content.encode() if isinstance(content, str) else content
    if kind == "run.json":
        return run_json(run, name, seed=seed).encode()
    if kind == "run.csv":
        return run_csv(run).encode()
    from viaspline.report.run_picture import run_picture

    return run_picture(run, name)


def check_kind(kind: str) -> None:
    """Refuse what can't be exported.

    Raises:
        RefusedError: Naming what can.
    """
    known = PLAN_FILES + RUN_FILES + FLEET_FILES
    if kind not in known:
        raise RefusedError(f"'{kind}' can't be exported; {', '.join(known)} can")
