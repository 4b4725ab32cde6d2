"""What is planned and flown in space on plain axes: from above, or in perspective on 3-D ones.

Tested through ``report/notebook/test_plain_axes``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from viaspline.maps.terrain import Terrain
from viaspline.mission.model import Mission
from viaspline.report import style
from viaspline.report.labels import Labels
from viaspline.report.notebook.plain_axes import map_on
from viaspline.report.path_marks import draw_path
from viaspline.report.space.solid_marks import draw_solids, name_roofs
from viaspline.report.space.space_view import draw_in_perspective
from viaspline.report.space.spatial_picture import draw_plan_view, plan_view_of, scene_of
from viaspline.report.space.spatial_scene import NamedSolid, SpatialScene
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_run import SpatialRun

if TYPE_CHECKING:
    from mpl_toolkits.mplot3d.axes3d import Axes3D


def draw_spatial_plan(plan: SpatialPlan, axes: Axes) -> list[Artist]:
    """The plan view; on axes in three dimensions the path among what stands near it."""
    scene = scene_of(plan)
    if axes.name == "3d":
        draw_in_perspective(cast("Axes3D", axes), [(plan.path, style.PATH)], scene)
        return []
    map_on(axes, plan_view_of(plan, scene))
    return draw_plan_view(axes, scene, plan)


def draw_spatial_run(run: SpatialRun, axes: Axes) -> list[Artist]:
    """What was flown, over the plan with which it began."""
    handles = draw_spatial_plan(run.plan, axes)
    if axes.name == "3d":
        return [*axes.plot(*run.positions.T, color=style.UNSEEN, linewidth=1.6, label="flown")]
    points = run.positions[:, :2]
    return [*handles, draw_path(axes, points, colour=style.UNSEEN, label="flown", zorder=8.5)]


def standing_scene(mission: Mission) -> SpatialScene:
    """What stands in the world of a mission in space, seen or not."""
    world = mission.world
    solids = [
        NamedSolid(one.solid(), one.name or "") for one in (*world.standing, *world.unseen_standing)
    ]
    ground = world.ground
    terrain: Terrain | None = None if ground is None else ground.terrain
    flat = None if ground is None or terrain is not None else ground.flat_m
    return SpatialScene(solids, terrain, flat, world.bounds)


def draw_standing(scene: SpatialScene, axes: Axes, labels: Labels) -> list[Artist]:
    """Solids and ground from above, in the bounds of their world; asks for heights."""
    handles = draw_solids(axes, scene)
    name_roofs(labels, scene)
    if scene.bounds is not None:
        x0, y0, x1, y1 = scene.bounds
        corners = np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)])
        handles += axes.plot(
            *corners.T, color=style.INK, linewidth=1.0, label="bounds", scalex=False, scaley=False
        )
    return handles
