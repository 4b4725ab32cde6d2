"""Curves, time laws, worlds and grids in facts, as rows of names and words.

Tested through ``report/notebook/test_notebook_page``.
"""

from __future__ import annotations

from collections import Counter

import numpy as np

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.path import Path
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.maps.grid import Grid
from viaspline.maps.terrain import Terrain
from viaspline.report.summary import counted
from viaspline.report.terminal.terminal_tables import Rows
from viaspline.report.units import curvature, metres, place, seconds
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.space.spatial_world import SpatialWorld
from viaspline.world.world import World

WHERE = {1: "on a line", 2: "in the plane", 3: "in space"}


def curve_facts(curve: PiecewiseCubic) -> Rows:
    """Length, via points, spans and curvature of a curve."""
    rows = [("length", metres(curve.length))]
    if isinstance(curve, CardinalSpline):
        rows.append(("via points", str(len(curve.points))))
    if isinstance(curve, Path):
        kinds = Counter(via.kind for via in curve.vias)
        rows.append(("points of the route", f"{kinds['user']}, and {kinds['detour']} of detours"))
    where = WHERE.get(curve.dimension, f"of {curve.dimension} coordinates")
    closed = ", closed" if curve.closed else ""
    rows.append(("spans", f"{len(curve.spans)}, {where}{closed}"))
    rows.append(("largest curvature", curvature(curve.max_curvature()[0])))
    return rows


def trajectory_facts(law: Trajectory) -> Rows:
    """Length, time, speed and stops of a time law."""
    begin, end = float(law.distances[0]), float(law.distances[-1])
    rows = [
        ("along the path", f"{metres(begin, 1)} to {metres(end, 1)}"),
        ("duration", seconds(law.duration)),
        ("largest speed", f"{float(law.speeds.max()):.2f} m/s"),
        ("accelerations", f"{law.accelerations.min():.2f} to {law.accelerations.max():.2f} m/s²"),
    ]
    stops = [stop for stop in law.stations if stop.dwell > 0.0]
    if stops:
        words = f"{counted(len(stops), 'stop')} of {sum(one.dwell for one in stops):g} s together"
        rows.append(("stations", words))
    return rows


def world_facts(world: World) -> Rows:
    """Obstacles, maps and bounds of a world."""
    grids = int(world.are_maps.sum())
    rows = [("obstacles", counted(len(world) - grids, "shape"))]
    if grids:
        rows.append(("maps", str(grids)))
    if world.bounds is not None:
        x0, y0, x1, y1 = world.bounds
        rows.append(("bounds", f"{place((x0, y0))} to {place((x1, y1))}"))
    if world.fences:
        rows.append(("fences", str(len(world.fences))))
    if world.corridor:
        rows.append(("corridor", "one that the robot stays inside of"))
    return rows


def spatial_world_facts(world: SpatialWorld) -> Rows:
    """Solids, ground and bounds of a world in space."""
    rows = [("solids", str(len(world)))]
    if isinstance(world.ground, Terrain):
        rows.append(
            ("ground", f"terrain, {world.ground.lowest:.1f} to {world.ground.highest:.1f} m")
        )
    elif world.ground is not None:
        rows.append(("ground", f"flat, at {metres(world.ground)}"))
    if world.bounds is not None:
        x0, y0, x1, y1 = world.bounds
        rows.append(("bounds", f"{place((x0, y0))} to {place((x1, y1))}"))
    return rows


def grid_facts(grid: Grid) -> Rows:
    """Size, place and what is blocked of a grid."""
    x, y, yaw = grid.origin
    rows = [
        ("cells", f"{grid.width} x {grid.height} of {grid.resolution:g} m"),
        ("blocked", f"{100.0 * float(np.mean(grid.blocked)):.1f} %"),
        ("origin", f"{place((x, y))}, turned by {np.degrees(yaw):g}°"),
    ]
    if grid.unknown is not None:
        rows.append(("unknown", f"{100.0 * float(np.mean(grid.unknown)):.1f} %, kept clear of"))
    if grid.source is not None:
        rows.append(("file", grid.source))
    return rows
