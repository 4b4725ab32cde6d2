"""The coordination diagram of two robots: where on its path one may be while the other is where.

Compare O'Donnell and Lozano-Pérez, "Deadlock-free and collision-free coordination of two robot
manipulators", ICRA 1989.

Tested through ``report/fleet/test_fleet_picture``.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection

from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.kernels.arrays import Floats
from viaspline.report import style
from viaspline.report.fleet.fleet_motion import span_of
from viaspline.report.fleet.fleet_page import name_panel

LINE_PIECES = 1200  # of the line that is driven


def pair_to_show(plan: FleetPlan) -> tuple[str, str] | None:
    """The two robots whose diagram says most: the tightest pair, or the one that waits longest.

    None where no two paths come near each other.
    """
    shown = plan.plans.keys()
    near = {
        frozenset((one.first, one.second))
        for one in plan.precedences
        if one.first in shown and one.second in shown
    }
    pair = plan.certificate.pair
    if pair is not None and frozenset(pair) in near:
        return pair
    waits = [one for one in plan.precedences if one.first in shown and one.second in shown]
    longest = max(waits, key=lambda one: one.waits_s, default=None)
    return None if longest is None else (longest.first, longest.second)


def draw_coordination(
    axes: Axes, plan: FleetPlan, pair: tuple[str, str], colours: Mapping[str, str]
) -> None:
    """Draw the diagram.

    Args:
        axes: Empty ones.
        plan: Of the fleet.
        pair: Two robots of it.
        colours: Of robots by name.
    """
    first, second = pair
    tightest = plan.certificate.pair is not None and set(pair) == set(plan.certificate.pair)
    which = "the tightest pair" if tightest else "the pair that waits longest"
    name_panel(axes, f"Coordination of {which}")
    ends = [plan.plans[name].path.length for name in pair]
    axes.set_xlim(0.0, max(ends[0], 1e-6))
    axes.set_ylim(0.0, max(ends[1], 1e-6))
    for side in (0, 1):
        boxes = forbidden_boxes(plan, pair[side], pair[1 - side])
        boxes = boxes if side == 0 else boxes[..., ::-1]
        axes.add_collection(
            PolyCollection(
                list(boxes), facecolors=style.MOVING_FILL, edgecolors=style.MOVING_FILL,
                linewidths=0.3, zorder=2,
            ),
            autolim=False,
        )  # fmt: skip
    times = np.linspace(*span_of(plan), LINE_PIECES)
    along = [np.asarray(plan.plans[name].trajectory.distance_at(times)) for name in pair]
    axes.plot(*along, color=style.INK, linewidth=1.5, zorder=4)
    if tightest:
        now = [float(plan.plans[n].trajectory.distance_at(plan.certificate.at_s)) for n in pair]
        axes.plot(
            *now, marker="o", markersize=8, markerfacecolor="none", linestyle="none",
            markeredgecolor=style.TIGHTEST, markeredgewidth=1.5, zorder=5, clip_on=False,
        )  # fmt: skip
    axes.set_xlabel(f"{style.short(first, 16)} along its path [m]", labelpad=2, parse_math=False)
    axes.set_ylabel(f"{style.short(second, 16)} along its path [m]", labelpad=2, parse_math=False)
    axes.xaxis.label.set_color(colours[first])
    axes.yaxis.label.set_color(colours[second])


def forbidden_boxes(plan: FleetPlan, robot: str, other: str) -> Floats:
    """Where two robots would be too near each other, by the cells of one of them.

    Returns:
        Corners of boxes: along the one's path, along the other's [m], (boxes, 4, 2).
    """
    courses, crossings = plan.courses.packed, plan.crossings.packed
    mine, its = (plan.courses.names.index(name) for name in (robot, other))
    boxes = np.arange(crossings.box_first[mine], crossings.box_first[mine + 1])
    boxes = boxes[crossings.other[boxes] == its]
    begin = courses.distance[crossings.cell[boxes]]
    end = courses.distance[crossings.cell[boxes] + 1]
    low, high = crossings.low[boxes], crossings.high[boxes]
    corners = [(begin, low), (end, low), (end, high), (begin, high)]
    found: Floats = np.array(corners).transpose(2, 0, 1)
    return found
