"""What the page can take away: the very files that the command line writes.

Tested through ``studio/test_server_files``.
"""

from __future__ import annotations

from typing import Final, TypeAlias

from viaspline.errors import ViasplineError
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.formats.items import LatLon
from viaspline.planner import Plan
from viaspline.report.files.csv_tables import path_csv, run_csv, spacing
from viaspline.report.files.plan_json import plan_json
from viaspline.report.files.run_json import run_json
from viaspline.report.proven_reference import PROVEN_WORDS
from viaspline.report.space.spatial_results import flight_file, spatial_plan_contents
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
PATH_FILES: Final = (
    "path.plan", "path.waypoints", "path.yaml", "path.mcap", "path.geojson", "path.kml", "path.gpx",
)  # fmt: skip
"""The proven path in formats of other people's; see ``viaspline.exports``."""

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


def path_file(
    plan: Plan | SpatialPlan, kind: str, name: str, origin: LatLon | None
) -> tuple[bytes, tuple[str, ...]]:
    """The path of a plan in a format of other people's, and what is to be said of it.

    Args:
        plan: The plan.
        kind: One of ``PATH_FILES``.
        name: The mission's name.
        origin: Latitude and longitude of the mission's 0, 0 [deg], if they are known.

    Raises:
        RefusedError: The format needs an origin, or no lines were found that are clear.
    """
    from viaspline.exports.export_options import ExportOptions
    from viaspline.exports.path_format import path_format_of
    from viaspline.exports.tabled_path import rendered

    file = f"{name}-{kind}"
    form = path_format_of(file)
    if form.is_geographic and origin is None:
        raise RefusedError(f"{file} holds latitudes and longitudes: give the origin of the mission")
    try:
        content, table = rendered(plan, form, ExportOptions(origin).checked(), name, file)
    except ViasplineError as error:
        raise RefusedError(str(error)) from None
    # Where it is written what that means, the page says by a link to its own copy.
    return content, tuple(words for words in table.remarks() if words != PROVEN_WORDS)


def run_file(run: AnyRun, kind: str, name: str, seed: int) -> bytes:
    """One of the files of a run: ``run.json``, ``run.png``, and of one robot ``run.csv``."""
    if isinstance(run, SimulatedFleet):
        return fleet_run_file(run, kind, name, seed)
    if isinstance(run, SpatialRun):
        return flight_file(run, kind, name)
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
    known = PLAN_FILES + PATH_FILES + RUN_FILES + FLEET_FILES
    if kind not in known:
        raise RefusedError(f"'{kind}' can't be exported; {', '.join(known)} can")
