"""A plan and a run in the plane on plain axes.

Tested through ``report/notebook/test_plain_axes``.
"""

from __future__ import annotations

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from viaspline.planner import Plan
from viaspline.report.driven_line import speed_colours
from viaspline.report.notebook.plain_axes import map_on
from viaspline.report.plan_picture import draw_plan_map, plan_scene
from viaspline.report.run_picture import draw_run_map, run_scene
from viaspline.robot.run import Run


def draw_plan(plan: Plan, axes: Axes) -> list[Artist]:
    """The map of ``plan.png``."""
    scene, view = plan_scene(plan)
    return draw_plan_map(map_on(axes, view), scene, plan)


def draw_run(run: Run, axes: Axes) -> list[Artist]:
    """The map of ``run.png``; the driven path is dark where it is slow."""
    scene, view = run_scene(run)
    handles = draw_run_map(map_on(axes, view), scene, run)
    colours, limits = speed_colours(run.speeds)
    words = f"driven path, dark at rest, bright at {limits.vmax:.3g} m/s"
    return [Line2D([], [], color=colours(0.6), linewidth=3.0, label=words), *handles]
