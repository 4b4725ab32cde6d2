"""What moves in space, from above: its ways while the robot flies, and where it comes nearest.

Tested through ``space/among/test_plan_past_moving``.
"""

from __future__ import annotations

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Circle

from viaspline.kernels.arrays import Floats
from viaspline.report import style
from viaspline.report.labels import Labels
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.spatial_plan import SpatialPlan

INSTANTS = 300  # at which ways are looked at
RANK = 6  # of the names of what moves


def solids_past(plan: SpatialPlan) -> tuple[MovingSolid, ...]:
    """What moves while a plan is flown."""
    law = plan.trajectory
    return MovingSolid.all_of(plan.mission, law.start_time, law.end_time)


def place_then(one: MovingSolid, times: Floats) -> Floats:
    """Where something is at times [s], (t,): [m], (t, 3); not a number where it isn't there."""
    at = np.column_stack([np.interp(times, one.times, one.places[:, k]) for k in range(3)])
    row = np.clip(np.searchsorted(one.times, times, side="right") - 1, 0, len(one.times) - 1)
    return np.where(one.there[row][:, None], at, np.nan)


def draw_moving_in_space(axes: Axes, labels: Labels, plan: SpatialPlan) -> list[Artist]:
    """Draw ways as lines and shapes as they are when the robot is nearest to one.

    Returns:
        What belongs in a legend; nothing where nothing moves.
    """
    solids = solids_past(plan)
    if not solids or plan.moving is None:
        return []
    law = plan.trajectory
    times = np.linspace(law.start_time, law.end_time, INSTANTS)
    now = np.array([min(max(plan.moving.tightest_at_s, law.start_time), law.end_time)])
    for one in solids:
        way = place_then(one, times)
        axes.plot(way[:, 0], way[:, 1], color=style.MOVING, linewidth=0.9, alpha=0.7, zorder=5)
        (x, y, z), radius = place_then(one, now)[0].tolist(), one.body[0] + one.body[2]
        if np.isfinite(x):
            body = Circle(
                (x, y), radius, facecolor=style.MOVING_FILL, edgecolor=style.MOVING, zorder=5.5
            )
            axes.add_patch(body)
            height = "" if one.body[1] > np.ptp(way[:, 2]) + 1e3 else f" at {z:.1f} m"
            labels.add(f"{style.short(one.name)}{height}", (x, y), rank=RANK, colour=style.MOVING)
    words = f"moves; as it is at {now[0]:.1f} s, when the robot is nearest"
    return [
        Line2D([], [], color=style.MOVING, marker="o", markersize=7, label=words,
               markerfacecolor=style.MOVING_FILL)
    ]  # fmt: skip
