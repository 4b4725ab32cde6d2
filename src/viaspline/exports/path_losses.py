"""What of a plan a format can't carry, or what has to be known to drive what it holds.

Tested through ``exports/test_export_path``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from viaspline.exports.corner_cut import turn_angles
from viaspline.exports.flown_over import flown_over
from viaspline.exports.path_format import PathFormat
from viaspline.exports.path_table import PathTable
from viaspline.planner import Plan
from viaspline.report.summary import counted
from viaspline.space.spatial_plan import SpatialPlan

MOST_ITEMS = 700
"""About so many items fit into the memory of common autopilots."""

MOST_NAMED = 4
"""Obstacles that are named in a line."""


def path_losses(plan: Plan | SpatialPlan, kind: PathFormat, table: PathTable) -> tuple[str, ...]:
    """What isn't in the file, a line for each thing.

    Args:
        plan: What is exported.
        kind: To which format.
        table: What is written of it.
    """
    return tuple(_left_out(plan, kind, table))


def driving_notes(plan: Plan | SpatialPlan, table: PathTable) -> tuple[str, ...]:
    """What has to be known by who lets a vehicle drive from point to point.

    Args:
        plan: What is exported.
        table: What is written of it.
    """
    return tuple(_of_driving(plan, table))


def _left_out(plan: Plan | SpatialPlan, kind: PathFormat, table: PathTable) -> Iterator[str]:
    route, robot = plan.mission.route, plan.mission.robot
    if "curve" not in kind.carries:
        yield "the exact curve: straight lines between points stand for it"
    moving = plan.moving_certificate if isinstance(plan, Plan) else plan.moving
    if moving is not None:
        yield "what moves: the path is proven clear of it only if it is driven at the planned times"
    if "times" not in kind.carries:
        yield "times"
    if "speeds" not in kind.carries:
        yield "speeds"
    dwells = [station.dwell for station in plan.trajectory.stations]
    if any(dwells) and "dwells" not in kind.carries:
        yield f"dwells: {sum(dwells):g} s at {counted(len(dwells), 'station')}"
    if "names" not in kind.carries and any(point.name for _, point in route.points()):
        yield "names of via points"
    if "headings" not in kind.carries and looks_elsewhere(plan):
        yield "headings that aren't along the path"
    over = list(flown_over(plan.mission, table.points).values()) if "fences" in kind.carries else []
    if over:
        more = f" and {len(over) - MOST_NAMED} more" if len(over) > MOST_NAMED else ""
        named = ", ".join(over[:MOST_NAMED]) + more
        yield f"fences round what it passes over or under, as they have no top: {named}"
    if robot.turn_radius is not None:
        sharpest = math.degrees(float(turn_angles(table.points).max(initial=0.0)))
        circle = f"the turning circle of {robot.turn_radius:g} m"
        yield f"{circle}: the lines meet in corners of up to {sharpest:.0f} degrees"
    if kind.is_geographic and table.has_heights and plan.mission.world.ground is None:
        yield "what heights are above: the mission has no ground, and is taken to begin on it"


def _of_driving(plan: Plan | SpatialPlan, table: PathTable) -> Iterator[str]:
    acceptance, dwells = table.proof.acceptance, table.dwells
    if acceptance is not None and acceptance > 0.0:
        yield (
            f"ArduPilot's rovers and copters don't read the acceptance radius of {acceptance:g} m "
            "from the file: set WP_RADIUS, or WPNAV_RADIUS, to no more than that"
        )
    else:
        yield (
            "it is proven for vehicles that drive up to each point and turn there: no larger "
            "acceptance radius was found to be clear. Autopilots take the 0 of the file for their "
            "own (PX4 NAV_ACC_RAD, ArduPilot WP_RADIUS or WPNAV_RADIUS), and cut corners by it"
        )
    if np.any(dwells != np.round(dwells)):
        yield "ArduPilot holds for whole seconds: parts of them are cut off"
    if len(table.points) > MOST_ITEMS:
        yield f"{len(table.points)} points: many autopilots hold about {MOST_ITEMS} items"
    yield "an autopilot rounds places to 1e-7 degree: up to 8 mm beside what is proven"
    if not table.has_heights:
        yield "the mission has no heights: those in the file are 0 above home, for ground and water"
    if isinstance(plan, SpatialPlan):
        yield "the vehicle climbs and descends with its own speeds"


def looks_elsewhere(plan: Plan | SpatialPlan) -> bool:
    """Whether the body looks anywhere else than along its path."""
    if isinstance(plan, Plan):
        return plan.mission.robot.held_heading is not None
    route = plan.mission.route
    return route.yaw not in (None, "along") or any(
        point.look_at is not None for _, point in route.points()
    )
