"""A mission on plain axes: its world, and the points of its route.

Tested through ``report/notebook/test_plain_axes``.
"""

from __future__ import annotations

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from viaspline.curve.path import PathVia
from viaspline.kernels.arrays import Floats
from viaspline.mission.model import Mission
from viaspline.planning.problem.requirements import Requirements
from viaspline.report import style
from viaspline.report.body_marks import draw_zones
from viaspline.report.labels import Labels
from viaspline.report.moving_film import MovingLayer
from viaspline.report.notebook.plain_axes import map_on
from viaspline.report.notebook.spatial_axes import draw_standing, standing_scene
from viaspline.report.scene import Scene
from viaspline.report.sheet import view_of
from viaspline.report.via_marks import draw_vias
from viaspline.world.moving_obstacles import MovingObstacles
from viaspline.world.world import World


def draw_mission(mission: Mission, axes: Axes) -> list[Artist]:
    """What stands in its world, seen or not, and its via points in order."""
    vias, line = _vias_of(mission)
    labels = Labels(axes)
    if mission.is_spatial:
        standing = standing_scene(mission)
        view = view_of(line, standing.corners(), standing.bounds, mission.robot.clearance_m)
        map_on(axes, view)
        handles = draw_standing(standing, axes, labels)
    else:
        required = Requirements.of(mission).required
        scene = Scene.of(World.known(mission), required, mission.world.unseen_standing)
        sheet = map_on(axes, view_of(line, scene.corners, scene.box, required))
        handles = scene.draw(axes, sheet.pixels_per_metre)
        scene.name(labels)
        handles += draw_zones(axes, labels, mission.world.speed_zones)
        moving = MovingLayer(axes, MovingObstacles.everything(mission), sheet.pixels_per_metre)
        moving.at(0.0)
        handles += moving.handles
    handles += axes.plot(
        *line.T, color=style.MUTED, linewidth=0.9, linestyle=(0, (2, 2)), zorder=6,
        label="order of the route", scalex=False, scaley=False,
    )  # fmt: skip
    marks, places = draw_vias(axes, labels, vias, mission)
    labels.place(line, places)
    return handles + marks


def _vias_of(mission: Mission) -> tuple[list[PathVia], Floats]:
    """The points of a route as via points, and the line through them [m], (n, 2)."""
    points = [point for _, point in mission.route.points()]
    vias = [
        PathVia(point.name or f"via {number}", tuple(point.at), "user", 0.0, point.dwell_s, number)
        for number, point in enumerate(points)
    ]
    line = np.array([point.at[:2] for point in points])
    return vias, np.vstack((line, line[:1])) if mission.route.closed else line
