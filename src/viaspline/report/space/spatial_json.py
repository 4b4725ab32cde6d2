"""``plan.json``, ``path.csv``, ``run.json`` and ``run.csv`` of a mission in space.

Tested through ``report/space/test_spatial_pictures``.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from viaspline.report.files.csv_tables import spacing, table_csv
from viaspline.report.files.drivability_json import drivability_data
from viaspline.report.files.json_text import dumps
from viaspline.report.files.moving_json import encounters_data, moving_certificate_data, waits_list
from viaspline.report.files.plan_json import (
    certificate_data,
    law_data,
    ledger_entry_data,
    mission_summary,
    path_data,
    stations_data,
)
from viaspline.report.proven_reference import PROVEN_KEY
from viaspline.report.space.heights_json import heights_data
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_run import SpatialRun
from viaspline.space.timing.yaw_profile import YawProfile


def spatial_plan_json(plan: SpatialPlan, name: str) -> str:
    """The text of ``plan.json``.

    Args:
        plan: What was planned.
        name: The mission's name.
    """
    return dumps(
        {
            "mission": _mission(plan, name),
            **PROVEN_KEY,
            "path": path_data(plan.path) | {"csv_spacing_m": spacing(plan.path.length)},
            "certificate": certificate_data(plan.certificate)
            | moving_certificate_data(plan.moving),
            "heights": heights_data(plan),
            "airborne_m": plan.airborne,
            "drivability": drivability_data(plan.drivability),
            "sharpest_radius_m": None if math.isinf(plan.sharpest_radius) else plan.sharpest_radius,
            "yaw": _yaw(plan.yaw),
            "ledger": [ledger_entry_data(entry) for entry in plan.ledger],
            "trajectory": {
                "duration_s": plan.trajectory.duration,
                "stations": stations_data(plan.trajectory),
                **({} if plan.moving is None else {"waits": waits_list(plan.waits)}),
                "law": law_data(plan.trajectory),
            },
        }
    )


def _mission(plan: SpatialPlan, name: str) -> dict[str, Any]:
    robot = plan.mission.robot
    return mission_summary(plan.mission, name) | {
        "frame": "ENU: x east, y north, z up; headings anticlockwise from x",
        "robot_half_height_m": robot.half_height_m,
        "max_climb_mps": robot.climb_speed,
        "max_descent_mps": robot.descent_speed,
    }


def _yaw(yaw: YawProfile) -> dict[str, Any]:
    """The headings at the nodes between which they are linear, only where they change."""
    bends = np.ones(len(yaw.headings), bool)
    bends[1:-1] = np.abs(np.diff(yaw.headings, 2)) > 1e-12
    return {"distances_m": yaw.distances[bends], "headings_rad": yaw.headings[bends]}


def spatial_path_csv(plan: SpatialPlan) -> str:
    """Points of the planned path, equally far apart; the last one is the path's end."""
    return table_csv(plan.samples(spacing(plan.path.length)))


def flight_json(run: SpatialRun, name: str) -> str:
    """The text of ``run.json``.

    Args:
        run: What was flown.
        name: The mission's name.
    """
    return dumps(
        {
            "name": name,
            **PROVEN_KEY,
            "reached": run.reached,
            "reason": run.reason or None,
            "duration_s": run.duration,
            "clearance_m": run.clearance,
            **encounters_data(run.encounters),
            **({} if run.encounters is None else {"broken_premises": run.broken_premises}),
            "replans": [
                {
                    "seen_at_s": one.seen_at,
                    "time_s": one.time,
                    "obstacles": one.obstacles,
                    "stopped": one.stopped,
                    "path": None if one.path is None else path_data(one.path),
                }
                for one in run.replans
            ],
            "note": "flown exactly as planned: nothing is kept for how far a robot gets beside it",
            "most_speed_mps": float(run.speeds.max()),
            "most_climb_mps": float(run.climbs.max()),
            "most_descent_mps": float(-run.climbs.min()),
        }
    )


def flight_csv(run: SpatialRun) -> str:
    """What was flown, over time."""
    return table_csv(run.samples())
