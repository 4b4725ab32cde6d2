"""Race tracks as closed corridors, beside their minimum-curvature lines.

    python benchmarks/racetracks.py FOLDER [TRACK ...]

FOLDER holds tracks/*.csv (x, y, width right, width left [m]) and racelines/*.csv (x, y [m]) as in
TUM's race track database. Both lines are driven under the same limits with the same time law; the
given one is interpolated by a periodic C2 spline. Ours starts on the middle line's first point and
keeps MARGIN to the borders everywhere; how near the given line comes to them is printed.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import shapely
from scipy.interpolate import CubicSpline
from timing import clock

import viaspline as vs

MARGIN = 0.75  # [m]; the given lines keep it nearly everywhere
ROBOT = {
    "radius_m": MARGIN, "clearance_m": 0.0,
    "max_speed_mps": 60.0, "max_accel_mps2": 8.0, "max_lateral_accel_mps2": 12.0,
}  # fmt: skip


def rows_of(file):
    return np.loadtxt(file, delimiter=",", comments="#")


def given_line(points):
    """Spans of the periodic C2 spline through points, by the length of their chords."""
    ring = np.vstack((points, points[:1]))
    along = np.r_[0.0, np.cumsum(np.linalg.norm(np.diff(ring, axis=0), axis=1))]
    spline = CubicSpline(along, ring, bc_type="periodic")
    steps = np.diff(along)[:, None]
    place, slope = spline(along), spline(along, 1)
    return np.stack(
        (place[:-1], place[:-1] + slope[:-1] * steps / 3,
         place[1:] - slope[1:] * steps / 3, place[1:]), axis=1,
    )  # fmt: skip


def lap_time(spans, limits):
    """Of a lap that is driven again and again [s]."""
    return vs.retime_lap(vs.PiecewiseCubic(spans, closed=True), limits).duration


def borders(rows):
    """Right and left, by normals to the chords."""
    middle = rows[:, :2]
    along = np.roll(middle, -1, axis=0) - np.roll(middle, 1, axis=0)
    along /= np.linalg.norm(along, axis=1)[:, None]
    across = np.column_stack((-along[:, 1], along[:, 0]))
    return middle - across * rows[:, 2:3], middle + across * rows[:, 3:4]


def least_room(spans, rows):
    """By shapely, 50 points a span: distance to the borders [m], negative outside of them."""
    edges = [shapely.Polygon(edge) for edge in borders(rows)]
    inner, outer = sorted(edges, key=lambda edge: edge.area)
    curve = vs.PiecewiseCubic(spans)
    points = shapely.points(curve.evaluate(np.linspace(0, len(spans), 50 * len(spans) + 1)))
    room = min(shapely.distance(edge.exterior, points).min() for edge in edges)
    inside = shapely.contains(outer, points).all() and not shapely.contains(inner, points).any()
    return float(room if inside else -room)


def main(folder, names):
    limits = vs.Limits(max_speed=60.0, max_accel=8.0, max_lateral_accel=12.0)
    print(
        f"{'track':14s} {'lap s':>7s} {'ratio':>7s} {'peak 1/m':>9s} {'ratio':>6s} "
        f"{'jump 1/m':>9s} {'proven m':>9s} {'shapely m':>9s} {'given m':>8s} {'plan s':>7s}"
    )
    worst = np.zeros(2)
    for name in names:
        file = folder / "tracks" / f"{name}.csv"
        rows = rows_of(file)
        given = given_line(rows_of(folder / "racelines" / f"{name}.csv"))
        mission = vs.Mission.model_validate({
            "robot": ROBOT,
            "route": {"start": rows[0, :2].tolist(), "closed": True, "corridor": {"csv": file}},
        })  # fmt: skip
        spent, plan = clock(lambda mission=mission: vs.plan(mission))
        spans = np.array(plan.path.spans)
        lap, lap_given = lap_time(spans, limits), lap_time(given, limits)
        peak, peak_given = (
            vs.PiecewiseCubic(each, closed=True).max_curvature()[0] for each in (spans, given)
        )
        jump = vs.PiecewiseCubic(spans, closed=True).curvature_jumps().max()
        worst = np.maximum(worst, (lap / lap_given, peak / peak_given))
        proven = plan.certificate.clearance + MARGIN if plan.certificate.holds else np.nan
        print(
            f"{name:14s} {lap:7.2f} {lap / lap_given:7.4f} {peak:9.4f} {peak / peak_given:6.3f} "
            f"{jump:9.1e} {proven:9.3f} {least_room(spans, rows):9.3f} "
            f"{least_room(given, rows):8.3f} {spent:7.2f}",
            flush=True,
        )
    print(f"worst: lap time {worst[0]:.4f}, peak curvature {worst[1]:.3f}")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        raise SystemExit(__doc__)
    tracks = Path(sys.argv[1])
    main(tracks, sys.argv[2:] or sorted(file.stem for file in tracks.glob("tracks/*.csv")))
