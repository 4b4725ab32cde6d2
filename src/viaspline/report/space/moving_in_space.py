"""What moves in space, from above: its ways while the robot flies, and where it comes nearest.

Tested through ``space/among/test_plan_past_moving``.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Circle

from viaspline.report import style
from viaspline.report.labels import Labels
from viaspline.space.among.moving_solid import MovingSolid
from viaspline.space.spatial_plan import SpatialPlan
from viaspline.space.spatial_run import SpatialRun

INSTANTS = 300  # at which ways are looked at
RANK = 6  # of the names of what moves


def solids_past(plan: SpatialPlan) -> tuple[MovingSolid, ...]:
    """What moves while a plan is flown."""
    law = plan.trajectory
    return MovingSolid.all_of(plan.mission, law.start_time, law.end_time)


def solids_met(run: SpatialRun) -> tuple[MovingSolid, ...]:
    """What moved while a robot flew: on its map, and not."""
    begin, end = float(run.times[0]), float(run.times[-1])
    mission = run.plan.mission
    on_map = MovingSolid.all_of(mission, begin, end)
    return (*on_map, *MovingSolid.unseen_of(mission, begin, end))


def draw_moving_in_space(axes: Axes, labels: Labels, plan: SpatialPlan) -> list[Artist]:
    """Draw ways as lines and shapes as they are when the robot is nearest to one.

    Returns:
        What belongs in a legend; nothing where nothing moves.
    """
    if plan.moving is None:
        return []
    law = plan.trajectory
    span = law.start_time, law.end_time
    return draw_moving_solids(axes, labels, solids_past(plan), span, plan.moving.tightest_at_s)


def draw_met_in_space(axes: Axes, labels: Labels, run: SpatialRun) -> list[Artist]:
    """Draw all that moved while a robot flew, on its map or not, and what touched it."""
    met = run.encounters
    if met is None:
        return draw_moving_in_space(axes, labels, run.plan)
    span = float(run.times[0]), float(run.times[-1])
    nearest_at = met.time if met.time is not None else 0.0
    found = draw_moving_solids(axes, labels, solids_met(run), span, nearest_at)
    return found + _draw_contacts(axes, labels, run)


def _draw_contacts(axes: Axes, labels: Labels, run: SpatialRun) -> list[Artist]:
    """Where something touched the robot."""
    contacts = () if run.encounters is None else run.encounters.contacts
    handles: list[Artist] = []
    for one in contacts:
        x, y = (float(np.interp(one.time, run.times, run.positions[:, k])) for k in (0, 1))
        handles = [*axes.plot(
            x, y, marker="X", markersize=9.0, markerfacecolor=style.TIGHTEST,
            markeredgecolor="white", linestyle="none", zorder=15, label="contact",
            scalex=False, scaley=False,
        )]  # fmt: skip
        how = "while it hovers" if one.robot_speed == 0.0 else "under way"
        words = f"{style.short(one.obstacle)} touches it {how}, {one.time:.0f} s"
        labels.add(words, (x, y), rank=4, colour=style.TIGHTEST)
    return handles


def draw_moving_solids(
    axes: Axes, labels: Labels, solids: Sequence[MovingSolid], span: tuple[float, float],
    nearest_at: float,
) -> list[Artist]:  # fmt: skip
    """Draw the ways of things for a while, and where they are at a time.

    Args:
        axes: Of the map.
        labels: Where names are asked for.
        solids: The things.
        span: From when to when their ways are drawn [s].
        nearest_at: When the shapes are drawn [s].

    Returns:
        What belongs in a legend; nothing where nothing moves.
    """
    if not solids:
        return []
    times = np.linspace(*span, INSTANTS)
    now = np.array([min(max(nearest_at, span[0]), span[1])])
    for one in solids:
        way = one.at(times)
        axes.plot(
            way[:, 0], way[:, 1], color=style.MOVING, linewidth=0.9, alpha=0.7, zorder=5,
            scalex=False, scaley=False,
        )  # fmt: skip
        (x, y, z), radius = one.at(now)[0].tolist(), one.body[0] + one.body[2]
        if np.isfinite(x):
            body = Circle(
                (x, y), radius, facecolor=style.MOVING_FILL, edgecolor=style.MOVING, zorder=5.5
            )
            axes.add_patch(body)
            height = "" if one.body[1] > np.ptp(way[:, 2]) + 1e3 else f" at {z:.1f} m"
            labels.add(f"{style.short(one.name)}{height}", (x, y), rank=RANK, colour=style.MOVING)
    words = f"moves; as at {now[0]:.1f} s, when it is nearest"
    return [
        Line2D([], [], color=style.MOVING, marker="o", markersize=7, label=words,
               markerfacecolor=style.MOVING_FILL)
    ]  # fmt: skip
