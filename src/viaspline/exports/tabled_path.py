"""A plan's path as a file of some format, and the table of what stands in it.

Tested through ``exports/test_export_path``.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise

import numpy as np

from viaspline.curve.path import Path as ProvenPath
from viaspline.errors import OutputError
from viaspline.exports.clear_polyline import ClearPolyline, polyline_proof
from viaspline.exports.cut_plan import cut_plan, not_clear, settable_speeds
from viaspline.exports.date_line import GeoCorners, with_crossings
from viaspline.exports.export_options import ExportOptions
from viaspline.exports.line_proof import LineProver
from viaspline.exports.line_speeds import set_speeds
from viaspline.exports.path_format import PathFormat
from viaspline.exports.path_losses import driving_notes, looks_elsewhere, path_losses
from viaspline.exports.path_table import DIGITS_DEG, DIGITS_M, ExportProof, PathTable
from viaspline.formats.items import LatLon
from viaspline.formats.local_frame import MAX_REACH_M, LocalFrame
from viaspline.kernels.arrays import Floats
from viaspline.mission.space.flight_places import ground_height
from viaspline.planner import Plan
from viaspline.space.spatial_plan import SpatialPlan


def rendered(
    plan: Plan | SpatialPlan, kind: PathFormat, options: ExportOptions, name: str, target: str
) -> tuple[bytes, PathTable]:
    """The file of a path, and what stands in it.

    Args:
        plan: What was planned.
        kind: The format.
        options: How, checked.
        name: What the path is called.
        target: What errors call the file.

    Raises:
        OutputError: The format needs an origin, or no lines were found that are clear.
    """
    options = options.placed(plan.mission)
    frame = _frame(kind, options, target, plan.path)
    lines, acceptance = cut_plan(plan, kind, options, target)
    points, geodetic = _as_written(lines.points, frame if kind.is_geographic else None)
    u = lines.parameters
    if kind.is_cut_at_180 and frame is not None and geodetic is not None:
        u, points, geodetic = with_crossings(GeoCorners(u, points, geodetic), plan.path, frame)
    lines = polyline_proof(plan.path, LineProver.of(plan), u, points, acceptance or 0.0)
    if not lines.holds:
        raise not_clear(lines, acceptance, target)
    if frame is not None and geodetic is None:
        geodetic = _as_written(points, frame)[1]
    table = _table(plan, lines, name, acceptance, options.origin, geodetic)
    notes = driving_notes(plan, table) if kind.is_driven else ()
    table = replace(table, lost=path_losses(plan, kind, table), notes=notes)
    return kind.write(table), table


def _table(
    plan: Plan | SpatialPlan,
    lines: ClearPolyline,
    name: str,
    acceptance: float | None,
    origin: LatLon | None,
    geodetic: Floats | None,
) -> PathTable:
    path, law = plan.path, plan.trajectory
    distances = np.asarray(path.distance(lines.parameters))
    k = int(np.argmin(lines.clearances))
    tightest = lines.proofs[k]
    proof = ExportProof(
        float(lines.clearances[k]), lines.required, tightest.at, tightest.nearest,
        lines.chord_error, acceptance,
    )  # fmt: skip
    settable = settable_speeds(plan)
    each = [settable.of_line(a, b) for a, b in pairwise(distances.tolist())]
    airborne = None
    headings = np.asarray(path.heading(lines.parameters))
    home = 0.0
    if isinstance(plan, SpatialPlan):
        first, last = (int(np.argmin(np.abs(distances - end))) for end in plan.airborne)
        airborne = (first, last)
        headings = plan.yaw.at(distances)
        ground = plan.mission.world.ground
        home = 0.0 if ground is None else ground_height(ground, *plan.mission.route.start.at[:2])
    return PathTable(
        name=name,
        mission=plan.mission,
        points=lines.points,
        distances=distances,
        headings=headings,
        names=tuple(_names(path, lines.parameters)),
        dwells=_dwells(plan, distances),
        times=np.asarray(law.time_at(distances)),
        speeds=np.asarray(law.speed_at(distances)),
        line_speeds=set_speeds(np.array(each)),
        airborne=airborne,
        origin=origin,
        geodetic=geodetic,
        home=home,
        looks_elsewhere=looks_elsewhere(plan),
        spans=path.spans,
        proof=proof,
        lost=(),
        notes=(),
    )


def _names(path: ProvenPath, u: Floats) -> Iterator[str | None]:
    vias = [via for via in path.vias if via.kind == "user"]
    for parameter in u.tolist():
        yield next((via.name for via in vias if abs(via.u - parameter) < 1e-6), None)


def _dwells(plan: Plan | SpatialPlan, distances: Floats) -> Floats:
    dwells = np.zeros(len(distances))
    for station in plan.trajectory.stations:
        dwells[int(np.argmin(np.abs(distances - station.distance)))] += station.dwell
    return dwells


def _as_written(points: Floats, frame: LocalFrame | None) -> tuple[Floats, Floats | None]:
    """Points as a file has them: rounded, in degrees where there is a frame."""
    if frame is None:
        return np.round(points, DIGITS_M) + 0.0, None
    degrees = np.stack(frame.to_geodetic(points[:, :2]), axis=1).round(DIGITS_DEG) + 0.0
    written = np.round(points, DIGITS_M) + 0.0
    written[:, :2] = frame.to_local(degrees[:, 0], degrees[:, 1])
    return written, degrees


def check_origin(kind: PathFormat, options: ExportOptions, target: str) -> None:
    """Refuse a format in degrees for a mission that lies nowhere on earth.

    Raises:
        OutputError: There is no origin, and the format needs one.
    """
    if kind.is_geographic and options.origin is None:
        problem = "holds latitudes and longitudes, but the mission is in metres without an origin"
        remedy = "give the latitude and longitude of its 0, 0: --origin LAT,LON, or origin=(47, 8)"
        raise OutputError(target, f"{problem}; {remedy}")


def _frame(
    kind: PathFormat, options: ExportOptions, target: str, path: ProvenPath
) -> LocalFrame | None:
    check_origin(kind, options, target)
    if options.origin is None:
        return None
    if float(np.abs(path.spans[..., :2]).max()) > 0.6 * MAX_REACH_M:
        problem = f"the path reaches more than {0.6 * MAX_REACH_M / 1e3:g} km from its origin"
        raise OutputError(target, f"{problem}; a file has one flat frame")
    return LocalFrame(*options.origin)
