"""The straight lines that a plan is exported as: what they run through, and what is asked of them.

Tested through ``exports/test_export_path``.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Final

import numpy as np

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError, OutputError
from viaspline.exports.clear_polyline import ClearPolyline, clear_polyline
from viaspline.exports.export_options import ExportOptions
from viaspline.exports.line_proof import LineProof, LineProver
from viaspline.exports.line_speeds import SettableSpeeds
from viaspline.exports.path_format import PathFormat
from viaspline.kernels.arrays import Floats
from viaspline.planner import Plan
from viaspline.space.spatial_plan import SpatialPlan

ACCEPTANCES: Final = (0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0)
"""Acceptance radii of which the largest is taken with which the path is clear [m]."""

CHORD_ERRORS: Final = (0.01, 0.25)
"""A tenth of the clearance is how far lines may be from the path, within these [m]."""

MOST_POINTS: Final = 50_000
_SAME_PLACE: Final = 1e-9  # in parameters, and in metres along the path


def cut_plan(
    plan: Plan | SpatialPlan, kind: PathFormat, options: ExportOptions, target: str
) -> tuple[ClearPolyline, float | None]:
    """Lines that hold, and the acceptance radius with which they do."""
    path = plan.path
    settable = settable_speeds(plan)
    spacing = options.spacing or kind.spacing or math.inf
    error = options.chord_error or _usual_error(plan.mission.robot.clearance_m)

    def may_join(a: float, b: float) -> bool:
        if not kind.is_driven:
            return True
        first, last = np.asarray(path.distance([a, b])).tolist()
        if last <= airborne[0] + _SAME_PLACE or first >= airborne[1] - _SAME_PLACE:
            return True  # a vehicle takes off and lands with its own speeds
        return last - first < 20.0 * error or settable.may_be_one(first, last)

    airborne = plan.airborne if isinstance(plan, SpatialPlan) else (0.0, path.length)
    known: dict[bytes, LineProof] = {}
    prover, fixed = LineProver.of(plan), _fixed(plan)
    breaks = _breaks(path, fixed, spacing)

    def cut(acceptance: float, most: int) -> ClearPolyline:
        return clear_polyline(
            path, prover, fixed, breaks, chord_error=error, acceptance=acceptance,
            may_join=may_join, most=most, known=known,
        )  # fmt: skip

    if not kind.is_driven or options.acceptance is not None:
        asked = options.acceptance if kind.is_driven else None
        lines = cut(asked or 0.0, MOST_POINTS)
        if not lines.holds:
            raise not_clear(lines, asked, target)
        return lines, asked
    best, taken = cut(0.0, MOST_POINTS), 0.0
    if not best.holds:
        raise not_clear(best, 0.0, target)
    most = 2 * len(best.points) + 20
    for acceptance in ACCEPTANCES:
        lines = cut(acceptance, most)
        if not lines.holds or len(lines.points) > most:
            break
        best, taken = lines, acceptance
    return best, taken


def not_clear(lines: ClearPolyline, acceptance: float | None, target: str) -> OutputError:
    """That lines don't hold, and what would help."""
    k = int(np.argmin(lines.clearances))
    proof, clearance = lines.proofs[k], float(lines.clearances[k])
    where = ", ".join(f"{x:.2f}" for x in proof.at)
    problem = (
        f"no straight lines near the path were found that keep {lines.required:g} m: at ({where}) "
        f"{clearance:.3f} m are proven beside {proof.nearest or 'what is there'}"
    )
    remedy = "plan with robot.prefer_clearance_m, which keeps more where there is room"
    if acceptance:
        remedy = f"give a smaller acceptance radius than {acceptance:g} m, or {remedy}"
    return OutputError(target, f"{problem}; {remedy}")


def settable_speeds(plan: Plan | SpatialPlan) -> SettableSpeeds:
    """What speeds may be set along a plan."""
    robot = plan.mission.robot
    brake = robot.max_brake_mps2 or robot.max_accel_mps2
    return SettableSpeeds(plan.trajectory, robot.max_accel_mps2, brake, robot.max_jerk_mps3)


def _fixed(plan: Plan | SpatialPlan) -> Floats:
    """Parameters of what lines have to run through: via points, stations, upright legs' ends."""
    path = plan.path
    stops = [station.distance for station in plan.trajectory.stations]
    if isinstance(plan, SpatialPlan):
        stops += plan.airborne
    vias = [via.u for via in path.vias if via.kind == "user"]
    last = path.domain[1]
    at = np.atleast_1d(np.asarray(path.parameter(np.clip(stops, 0.0, path.length))))
    found = np.unique(np.r_[0.0, vias, at, last])
    # A station's parameter is reckoned from its distance, and misses its via point by a hair.
    known = np.array([0.0, *vias, last])
    near = np.abs(found[:, None] - known[None, :])
    snapped = np.where(near.min(axis=1) < 1e-6, known[near.argmin(axis=1)], found)
    kept = np.unique(snapped)
    return np.asarray(kept[np.r_[True, np.diff(kept) > _SAME_PLACE]])


def _breaks(path: PiecewiseCubic, fixed: Floats, spacing: float) -> Floats:
    """Parameters of places no farther apart along the path than a spacing [m], evenly."""
    if not math.isfinite(spacing):
        return np.empty(0)
    ends = np.asarray(path.distance(fixed))
    counts = np.maximum(np.ceil(np.diff(ends) / spacing - 1e-9), 1).astype(int)
    if counts.sum() > MOST_POINTS:
        problem = f"lines of {spacing:g} m make {counts.sum()} points of {path.length:.0f} m"
        raise GeometryError(f"{problem}, more than {MOST_POINTS}; give a larger spacing")
    at = np.concatenate(
        [np.linspace(a, b, n + 1) for (a, b), n in zip(pairwise(ends), counts, strict=True)]
    )
    return np.asarray(path.parameter(np.clip(at, 0.0, path.length)))


def _usual_error(clearance: float) -> float:
    low, high = CHORD_ERRORS
    return min(max(0.1 * clearance, low), high)
