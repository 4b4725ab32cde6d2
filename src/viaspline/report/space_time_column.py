"""The panel of space and time in the column beside a map.

Tested through ``report/test_moving_pictures``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.planner import Plan
from viaspline.report.side_column import SideColumn
from viaspline.report.space_time import SpaceTime, kept_from_moving, line_of
from viaspline.report.space_time_panel import draw_space_time
from viaspline.report.style import SMALL_PT
from viaspline.robot.run import Run

HEIGHT_IN = 2.2
NUMBERS_IN = 0.26
TITLE = "Blocked by what moves: time [s] over\ndistance [m]"
FREE_WORDS = "; dashed: if nothing moved"


def plan_space_time(column: SideColumn, plan: Plan) -> None:
    """When a plan's path is blocked where, and how its law goes through that."""
    if plan.timed is None:
        return
    shown = SpaceTime.of_plan(plan)
    _draw(column, shown, line_of(plan.trajectory), line_of(plan.timed.free))


def run_space_time(column: SideColumn, run: Run) -> None:
    """When the driven path was blocked where, and how the robot went through that."""
    if not len(run.moving):
        return
    begin, end = float(run.times[0]), float(run.times[-1])
    steps = np.hypot(*np.diff(run.positions[:, :2], axis=0).T)
    driven = np.concatenate([[0.0], np.cumsum(steps)])
    required = kept_from_moving(run.plan)
    shown = SpaceTime(run.path, run.moving, required, begin, max(end, begin + 1e-3))
    _draw(column, shown, np.column_stack((driven, run.times)), None)


def _draw(column: SideColumn, shown: SpaceTime, driven: Floats, free: Floats | None) -> None:
    """The panel, if there is room for it."""
    if column.room < HEIGHT_IN + 0.8:
        return
    title = TITLE if free is None else f"{TITLE}{FREE_WORDS}"
    axes = column.axes(HEIGHT_IN, title, inset=NUMBERS_IN)
    draw_space_time(axes, shown, driven, free)
    axes.tick_params(left=True, bottom=True, labelleft=True, labelbottom=True, labelsize=SMALL_PT)
