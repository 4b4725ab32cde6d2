"""``plan.json``: the exact curve, its proof and the ledger of what was tried."""

from __future__ import annotations

from typing import Any

from viaspline.curve.bending import curvature_bound
from viaspline.curve.certificate import Certificate
from viaspline.curve.path import Path
from viaspline.mission.model import Mission
from viaspline.planner import Plan
from viaspline.planning.problem.ledger import LedgerEntry
from viaspline.planning.problem.preferred_clearance import PreferredClearance
from viaspline.report.files.drivability_json import drivability_data
from viaspline.report.files.json_text import dumps
from viaspline.report.files.moving_json import moving_certificate_data, timing_choices, waits_data
from viaspline.report.proven_reference import PROVEN_KEY
from viaspline.report.remarks import FOLLOWED_EXACTLY, keeps_nothing
from viaspline.report.summary import tension
from viaspline.trajectory.trajectory import Trajectory


def plan_json(plan: Plan, name: str, *, spacing: float) -> str:
    """The text of ``plan.json``.

    Args:
        plan: What was planned.
        name: The mission's name.
        spacing: Distance between the points in ``path.csv`` [m].
    """
    return dumps(
        {
            "mission": mission_summary(plan.mission, name),
            **PROVEN_KEY,
            "path": path_data(plan.path) | _turning(plan) | {"csv_spacing_m": spacing},
            "certificate": certificate_data(plan.certificate)
            | moving_certificate_data(plan.moving_certificate),
            "drivability": drivability_data(plan.drivability),
            **({"tracking_error_m": plan.tracking_error} if plan.tracking_error else {}),
            **({"note": FOLLOWED_EXACTLY} if keeps_nothing(plan.mission.robot) else {}),
            "ledger": [ledger_entry_data(entry) for entry in plan.ledger],
            **_preferred(plan.preferred_clearance),
            **timing_choices(plan),
            "trajectory": {
                "duration_s": plan.trajectory.duration,
                "stations": stations_data(plan.trajectory),
                **waits_data(plan),
                "law": law_data(plan.trajectory),
            },
        }
    )


def _turning(plan: Plan) -> dict[str, Any]:
    """The proven bound of the curvature, for a robot with a turning circle."""
    if plan.mission.robot.turn_radius is None:
        return {}
    return {"curvature_bound_1pm": curvature_bound(plan.path)[0]}


def mission_summary(mission: Mission, name: str) -> dict[str, Any]:
    """What somebody who finds the file later needs to read it."""
    robot, spline = mission.robot, mission.spline
    return {
        "name": name,
        "frame": "ENU: x east, y north; headings anticlockwise from x",
        "robot_radius_m": robot.radius_m if robot.footprint is None else None,
        "footprint": robot.footprint,
        "turn_radius_m": robot.turn_radius,
        "required_clearance_m": robot.clearance_m,
        "max_speed_mps": robot.max_speed_mps,
        "max_accel_mps2": robot.max_accel_mps2,
        "max_lateral_accel_mps2": robot.lateral_accel,
        "optimise": mission.route.optimise,
        "tension": tension(mission),
        "knots": spline.knots,
        "tangents": mission.tangents,
        "closed": mission.route.closed,
        "laps": mission.route.laps,
    }


def path_data(path: Path) -> dict[str, Any]:
    """A path: exact spans, via points, length and largest curvature."""
    return {
        "spans": path.spans,
        "vias": [
            {
                "name": via.name,
                "at": via.at,
                "distance_m": distance,
                "kind": via.kind,
                "dwell_s": via.dwell,
                "u": via.u,
                "route_index": via.index,
            }
            for via, distance in zip(path.vias, path.via_distances, strict=True)
        ],
        "length_m": path.length,
        "max_curvature_1pm": path.max_curvature()[0],
    }


def stations_data(law: Trajectory) -> list[dict[str, Any]]:
    """Where it stops, and for how long."""
    return [
        {"name": one.name, "distance_m": one.distance, "dwell_s": one.dwell} for one in law.stations
    ]


def law_data(law: Trajectory) -> dict[str, Any]:
    """A time law, exactly; without what it doesn't have."""
    columns = {
        "distances_m": law.distances,
        "speeds_mps": law.speeds,
        "times_s": law.times,
        "accelerations_mps2": law.accelerations,
        "changes_1ps2": law.changes,
        "jerks_mps3": law.jerks,
        "over_limit_until_m": law.over_limit_until,
        "over_jerk_until_m": law.over_jerk_until,
    }
    return {name: values for name, values in columns.items() if values is not None}


def certificate_data(certificate: Certificate) -> dict[str, Any]:
    """A certificate; ``clearance_m`` is null when there is nothing to keep clear of."""
    return {
        "clearance_m": certificate.clearance,
        "required_clearance_m": certificate.required,
        "holds": certificate.holds,
        "tightest_at": certificate.tightest_at,
        "tightest_distance_m": certificate.tightest_distance,
        "nearest": certificate.obstacle,
    }


def _preferred(weighed: PreferredClearance | None) -> dict[str, Any]:
    """What more clearance than required would cost, where the mission asks for it."""
    if weighed is None:
        return {}
    return {
        "preferred_clearance": {
            "asked_m": weighed.asked,
            "taken_m": weighed.taken,
            "required_duration_s": weighed.duration,
            "most_duration_s": weighed.most_duration,
            "tried": [
                {"clearance_m": one.clearance, "duration_s": one.duration, "taken": one.taken}
                for one in weighed.tried
            ],
        }
    }


def ledger_entry_data(entry: LedgerEntry) -> dict[str, Any]:
    """A group that was met, and the ways past it."""
    return {
        "members": entry.members,
        "leg": entry.leg,
        "chosen": None if entry.chosen is None else entry.chosen.side,
        "forced": entry.forced,
        "candidates": [
            {
                "side": candidate.side,
                "chosen": candidate.chosen,
                "vias": candidate.vias,
                "spans": candidate.spans,
                "length_m": candidate.length,
                "duration_s": candidate.duration,
                "clearance_m": candidate.clearance,
                "max_curvature_1pm": candidate.max_curvature,
                "impossible": candidate.impossible,
                "passed_over": candidate.passed_over,
            }
            for candidate in entry.candidates
        ],
    }
