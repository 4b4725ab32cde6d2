"""Doors from a value to the rooms above it, opened when somebody goes through.

Data flows one way, and so do imports: a plan is made long before it is drawn, and mustn't import
what draws it. Yet a person who has a plan at hand says ``plan.plot()``. So a value carries the
verb, and this table says in which module what it does stands, as a string: it is imported when the
verb is used. `DOORS` is the whole list; a test opens every one of them.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from types import MappingProxyType
from typing import Any, Final

from viaspline.errors import GeometryError

DOORS: Final = MappingProxyType(
    {
        # In words: a value's facts, as rows of a name and what it is.
        "facts of Mission": "report.summary:summary",
        "facts of Fleet": "report.fleet_summary:fleet_summary",
        "facts of Plan": "report.terminal.plan_tables:plan_rows",
        "facts of SpatialPlan": "report.space.spatial_tables:spatial_plan_rows",
        "facts of Run": "report.terminal.run_tables:run_rows",
        "facts of SpatialRun": "report.space.spatial_tables:spatial_run_rows",
        "facts of FleetPlan": "report.terminal.fleet_tables:fleet_rows",
        "facts of FleetRun": "report.terminal.fleet_tables:fleet_run_rows",
        "facts of PiecewiseCubic": "report.notebook.part_facts:curve_facts",
        "facts of Trajectory": "report.notebook.part_facts:trajectory_facts",
        "facts of World": "report.notebook.part_facts:world_facts",
        "facts of SpatialWorld": "report.notebook.part_facts:spatial_world_facts",
        "facts of Grid": "report.notebook.part_facts:grid_facts",
        # On axes: what draws it, and gives the artists that belong in a legend.
        "marks of Mission": "report.notebook.mission_axes:draw_mission",
        "marks of Fleet": "report.notebook.fleet_axes:draw_fleet",
        "marks of Plan": "report.notebook.result_axes:draw_plan",
        "marks of SpatialPlan": "report.notebook.spatial_axes:draw_spatial_plan",
        "marks of Run": "report.notebook.result_axes:draw_run",
        "marks of SpatialRun": "report.notebook.spatial_axes:draw_spatial_run",
        "marks of FleetPlan": "report.notebook.fleet_axes:draw_fleet_plan",
        "marks of FleetRun": "report.notebook.fleet_axes:draw_fleet_run",
        "marks of PiecewiseCubic": "report.notebook.part_axes:draw_curve",
        "marks of Trajectory": "report.notebook.part_axes:draw_trajectory",
        "marks of World": "report.notebook.part_axes:draw_world",
        "marks of Grid": "report.notebook.part_axes:draw_grid",
        # As it moves.
        "film of Run": "report.notebook.moving_axes:animate_run",
        "film of SpatialRun": "report.notebook.moving_axes:animate_flight",
        "film of FleetPlan": "report.notebook.moving_fleet:animate_fleet_plan",
        "film of FleetRun": "report.notebook.moving_fleet:animate_fleet_run",
        # Into files.
        "files of Plan": "report.notebook.saved_results:plan_files",
        "files of SpatialPlan": "report.notebook.saved_results:spatial_plan_files",
        "files of FleetPlan": "report.notebook.saved_results:fleet_plan_files",
        "files of Run": "report.notebook.saved_results:run_files",
        "files of SpatialRun": "report.notebook.saved_results:spatial_run_files",
        "files of FleetRun": "report.notebook.saved_results:fleet_run_files",
        # What all of them share.
        "summary": "report.notebook.notebook_page:summary_text",
        "page": "report.notebook.notebook_page:html_page",
        "picture": "report.notebook.notebook_picture:picture",
        "plot": "report.notebook.plain_axes:plot",
        "save": "report.notebook.saved_results:save",
        "export": "exports.export_path:export",
    }
)
"""What is behind each door: ``module:function``, the module named from ``viaspline`` on."""


def opened(door: str) -> Callable[..., Any]:
    """The function behind a door.

    Raises:
        GeometryError: There is no such door, or its room isn't part of this installation.

    >>> opened("summary").__name__
    'summary_text'
    """
    if door not in DOORS:
        raise GeometryError(f"there is no door {door!r}; there are {', '.join(DOORS)}")
    module, function = DOORS[door].split(":")
    return getattr(import_module(f"viaspline.{module}"), function)  # type: ignore[no-any-return]


def opened_for(verb: str, value: object) -> Callable[..., Any]:
    """The function that does something with a value: by its class, or the next one above it.

    Args:
        verb: Such as ``facts`` or ``marks``.
        value: With which it is done.

    Raises:
        GeometryError: Nothing does that with a value of its class.

    >>> opened_for("facts", 5)
    Traceback (most recent call last):
    viaspline.errors.GeometryError: there are no facts of the class int
    """
    for made in type(value).__mro__:
        if f"{verb} of {made.__name__}" in DOORS:
            return opened(f"{verb} of {made.__name__}")
    raise GeometryError(f"there are no {verb} of the class {type(value).__name__}")
