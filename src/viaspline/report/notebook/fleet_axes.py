"""A fleet, its plan and its drive on plain axes.

Tested through ``report/notebook/test_plain_axes``.
"""

from __future__ import annotations

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection

from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.fleet.fleet_certificate import FleetCertificate
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.timelines import timelines_of
from viaspline.mission.fleet.fleet import Fleet
from viaspline.report import style
from viaspline.report.fleet.fleet_colours import KIND_COLOURS, colours_of, fleet_colours
from viaspline.report.fleet.fleet_map import draw_fleet_on, robot_keys
from viaspline.report.fleet.fleet_map import scene_of as fleet_scene_of
from viaspline.report.fleet.fleet_marks import draw_ends, draw_stations, goal_of, name_robots
from viaspline.report.fleet.fleet_picture import motion_of
from viaspline.report.labels import Labels
from viaspline.report.notebook.plain_axes import map_on, name_axes
from viaspline.report.scene import Scene
from viaspline.report.sheet import view_of
from viaspline.world.world import World

INSTANTS_DRAWN = 400  # of each robot's progress


def draw_fleet(fleet: Fleet, axes: Axes) -> list[Artist]:
    """The world of a fleet, with the starts and goals of its robots."""
    members = fleet.members
    apart = FleetCertificate(np.inf, fleet.separation_m, None, 0.0, None)
    colours = fleet_colours([one.name for one in members], fleet, (), apart)
    ends = [one.mission.route.start.at[:2] for one in members]
    seen = np.array([*ends, *map(goal_of, members)]).reshape(-1, 2)
    least = min((one.mission.robot.radius_m + one.mission.robot.clearance_m for one in members),
                default=0.0)  # fmt: skip
    scene = Scene.of(World.known(members[0].mission), least)
    sheet = map_on(axes, view_of(seen, scene.corners, scene.box, max(least, 0.5)))
    handles = scene.draw(axes, sheet.pixels_per_metre)
    labels = Labels(axes)
    marks, places = draw_ends(axes, members, colours)
    marks += draw_stations(axes, members)
    name_robots(labels, members, colours)
    scene.name(labels)
    labels.place(np.zeros((0, 2)), places, marker_size=5.0)
    return [*robot_keys(colours), *marks, *handles]


def draw_fleet_plan(plan: FleetPlan, axes: Axes) -> list[Artist]:
    """The map of ``fleet.png``: paths, starts and goals, and who waits for whom."""
    scene, view = fleet_scene_of(plan)
    timelines = timelines_of(plan)
    colours = fleet_colours(list(plan.plans), plan.fleet, timelines, plan.certificate)
    sheet = map_on(axes, view)
    return draw_fleet_on(sheet, scene, plan, timelines, motion_of(plan), colours)


def draw_fleet_run(run: FleetRun, axes: Axes) -> list[Artist]:
    """How far each robot had come, over time: who waits doesn't rise."""
    name_axes(axes, "time [s]", "distance along the path [m]")
    times = np.linspace(0.0, max(run.end_s, 1e-9), INSTANTS_DRAWN)
    try:
        inks = colours_of(len(run.names))
    except ValueError:
        inks = []
    told = len(inks) == len(run.names)
    lines = [np.column_stack((times, run.distance_at(name, times))) for name in run.names]
    if told:
        return [
            axes.plot(*line.T, color=ink, linewidth=1.4, label=style.short(name, 24))[0]
            for line, ink, name in zip(lines, inks, run.names, strict=True)
        ]
    many = LineCollection(lines, colors=KIND_COLOURS[0], linewidths=0.7)
    many.set_label(f"{len(lines)} robots")
    axes.add_collection(many)
    axes.autoscale_view()
    return [many]
