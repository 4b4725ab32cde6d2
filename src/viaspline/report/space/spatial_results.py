"""Everything that a plan or a flight in space leaves in its folder.

Tested through ``report/space/test_spatial_pictures``.
"""

from __future__ import annotations

from viaspline.report.files.results import Contents
from viaspline.report.space.flight_picture import flight_picture
from viaspline.report.space.spatial_json import (
    flight_csv,
    flight_json,
    spatial_path_csv,
    spatial_plan_json,
)
from viaspline.report.space.spatial_picture import spatial_picture
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_run import SpatialRun


def spatial_plan_contents(plan: SpatialPlan, name: str) -> Contents:
    """The files of a plan: the same bytes every time."""
    return {**spatial_path_contents(plan, name), "plan.png": spatial_picture(plan, name)}


def spatial_path_contents(plan: SpatialPlan, name: str) -> Contents:
    """The files of a plan without its picture."""
    return {"plan.json": spatial_plan_json(plan, name), "path.csv": spatial_path_csv(plan)}


def flight_file(run: SpatialRun, kind: str, name: str) -> bytes:
    """One of the files of a flight: ``run.json``, ``run.csv`` or ``run.png``."""
    if kind == "run.png":
        return flight_picture(run, name)
    return (flight_json(run, name) if kind == "run.json" else flight_csv(run)).encode()


def spatial_run_contents(run: SpatialRun, name: str) -> Contents:
    """The files of a flight, without those of its plan."""
    return {
        "run.json": flight_json(run, name),
        "run.csv": flight_csv(run),
        "run.png": flight_picture(run, name),
    }
