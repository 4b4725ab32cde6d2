"""Curves, time laws, worlds and grids on plain axes.

Tested through ``report/notebook/test_plain_axes``.
"""

from __future__ import annotations

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from viaspline.curve.cardinal import CardinalSpline
from viaspline.curve.path import Path
from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.kernels.arrays import Floats
from viaspline.maps.grid import Grid
from viaspline.report import style
from viaspline.report.canvas import polyline
from viaspline.report.labels import Labels
from viaspline.report.map_ground import MapGround
from viaspline.report.notebook.plain_axes import map_on, name_axes
from viaspline.report.path_marks import draw_arrows, draw_path
from viaspline.report.scene import Scene
from viaspline.report.sheet import Box, view_of
from viaspline.trajectory.trajectory import Trajectory
from viaspline.world.world import World

FINE = 1000  # points of a curve that is drawn over its parameter


def draw_curve(curve: PiecewiseCubic, axes: Axes) -> list[Artist]:
    """A curve with its via points; over axes in three dimensions as it is, else from above."""
    if curve.dimension == 1:
        return _draw_over_parameter(curve, axes)
    places, words = _marked(curve)
    if axes.name == "3d" and curve.dimension == 3:
        line = np.asarray(curve.evaluate(np.linspace(*curve.domain, FINE)))
        low, high = line.min(axis=0), line.max(axis=0)
        half = 0.5 * np.maximum(high - low, 0.1 * float((high - low).max()) + 1e-9)
        middle = 0.5 * (low + high)
        axes.set(**{f"{name}lim": (middle[k] - half[k], middle[k] + half[k])
                    for k, name in enumerate("xyz")})  # fmt: skip
        drawn: list[Artist] = [*axes.plot(*line.T, color=style.PATH, label="curve")]
        drawn += axes.plot(*places.T, "o", color=style.INK, markersize=4, label=words)
        return drawn
    points = polyline(curve.spans)
    sheet = map_on(axes, view_of(points, np.zeros((0, 2)), None, 0.0))
    handles: list[Artist] = [draw_path(axes, points, label="curve")]
    draw_arrows(axes, points, style.PATH, avoid=places[:, :2])
    handles += axes.plot(
        *places[:, :2].T, marker="o", markersize=5.5, markerfacecolor="white",
        markeredgecolor=style.INK, linestyle="none", zorder=12, label=words,
        scalex=False, scaley=False,
    )  # fmt: skip
    assert sheet.map is axes
    return handles


def _marked(curve: PiecewiseCubic) -> tuple[Floats, str]:
    """The places of a curve that are marked, (k, d), and what they are."""
    if isinstance(curve, CardinalSpline):
        return curve.points, "via point"
    if isinstance(curve, Path) and curve.vias:
        return np.array([via.at for via in curve.vias]), "via point"
    return np.concatenate((curve.spans[:, 0], curve.spans[-1:, 3])), "joint of spans"


def _draw_over_parameter(curve: PiecewiseCubic, axes: Axes) -> list[Artist]:
    """A curve of one coordinate."""
    u = np.linspace(*curve.domain, FINE)
    name_axes(axes, "parameter u", "value")
    return [*axes.plot(u, np.asarray(curve.evaluate(u))[:, 0], color=style.PATH, label="curve")]


def draw_trajectory(law: Trajectory, axes: Axes) -> list[Artist]:
    """The speed over time; stops are where it is 0."""
    times = np.unique(np.concatenate((np.linspace(law.start_time, law.end_time, FINE), law.times)))
    speeds = np.asarray(law.state_at(times)[1])
    name_axes(axes, "time [s]", "speed [m/s]")
    (line,) = axes.plot(times, speeds, color=style.PATH, linewidth=1.6, label="speed")
    axes.fill_between(times, speeds, color=style.PATH, alpha=0.12, linewidth=0.0)
    handles: list[Artist] = [line]
    stops = [stop for stop in law.stations if stop.dwell > 0.0]
    if stops:
        arrivals = np.asarray(law.time_at([stop.distance for stop in stops]))
        handles += axes.plot(
            arrivals, np.zeros(len(stops)), marker="s", color=style.STATION, linestyle="none",
            markeredgecolor=style.INK, label="station", clip_on=False, zorder=5,
        )  # fmt: skip
    axes.set_ylim(bottom=0.0)
    return handles


def draw_world(world: World, axes: Axes) -> list[Artist]:
    """Obstacles, maps, bounds and fences, with their names."""
    scene = Scene.of(world, 0.0)
    sheet = map_on(axes, scene_view(scene))
    handles = scene.draw(axes, sheet.pixels_per_metre)
    labels = Labels(axes)
    scene.name(labels)
    labels.place(np.zeros((0, 2)), np.zeros((0, 2)))
    return handles


def scene_view(scene: Scene) -> Box:
    """All that stands in a scene; a metre about 0, 0 where there is nothing."""
    corners = scene.corners
    if not len(corners):
        return -1.0, -1.0, 1.0, 1.0
    return view_of(corners, corners, scene.box, 0.0)


def draw_grid(grid: Grid, axes: Axes) -> list[Artist]:
    """Blocked and unknown squares, and the edge of the grid."""
    corners = grid.corners
    map_on(axes, view_of(corners, corners, None, 0.0))
    label = "blocked" if grid.source is None else style.short(f"blocked in {grid.source}")
    handles: list[Artist] = [*MapGround(grid, label).draw(axes, zorder=2.4)]
    edge = np.vstack((corners, corners[:1]))
    handles += axes.plot(
        *edge.T, color=style.INK, linewidth=1.0, label="edge of the grid",
        scalex=False, scaley=False,
    )  # fmt: skip
    return handles
