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
from viaspline.report.fleet.fleet_page import name_panel
from viaspline.report.fleet.places_over_time import span_of

LINE_PIECES = 600  # of the line that is driven, beside the points of both laws
WINDOW_M = 30.0  # about the crossing that is passed by closest, either way [m]
MARGIN_M = 12.0  # around what is shown of it [m]
WORTH_A_WINDOW = 0.5  # of a path: what shows more of it shows it whole


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
    window = shown_window(plan, pair)
    axes.set_xlim(*window[0])
    axes.set_ylim(*window[1])
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
    knots = [plan.plans[name].trajectory.times for name in pair]
    times = np.unique(np.concatenate([np.linspace(*span_of(plan), LINE_PIECES), *knots]))
    along = [np.asarray(plan.plans[name].trajectory.distance_at(times)) for name in pair]
    axes.plot(*along, color=style.INK, linewidth=1.5, zorder=4)
    if tightest:
        now = _places_at(plan, pair, plan.certificate.at_s)
        axes.plot(
            *now, marker="o", markersize=8, markerfacecolor="none", linestyle="none",
            markeredgecolor=style.TIGHTEST, markeredgewidth=1.5, zorder=5, clip_on=False,
        )  # fmt: skip
    axes.set_xlabel(f"{style.short(first, 16)} along its path [m]", labelpad=2, parse_math=False)
    axes.set_ylabel(f"{style.short(second, 16)} along its path [m]", labelpad=2, parse_math=False)
    axes.xaxis.label.set_color(colours[first])
    axes.yaxis.label.set_color(colours[second])


def shown_window(plan: FleetPlan, pair: tuple[str, str]) -> list[tuple[float, float]]:
    """From where to where along either path the diagram goes [m].

    It is all of them where that isn't long; else about the crossing that is passed by closest.
    """
    ends = [max(plan.plans[name].path.length, 1e-6) for name in pair]
    boxes = forbidden_boxes(plan, *pair)
    if not len(boxes):
        return [(0.0, end) for end in ends]
    times = np.linspace(*span_of(plan), LINE_PIECES)
    line = np.column_stack([_places_at(plan, pair, times)[0], _places_at(plan, pair, times)[1]])
    corners = np.vstack([boxes.min(axis=1), boxes.max(axis=1)]).reshape(2, -1, 2)
    apart = np.maximum(corners[0][None] - line[:, None], line[:, None] - corners[1][None])
    nearest = int(np.hypot(*np.maximum(apart, 0.0).transpose(2, 0, 1)).min(axis=0).argmin())
    middle = corners[:, nearest].mean(axis=0)
    near = np.abs(corners - middle).max(axis=(0, 2)) < WINDOW_M
    low, high = corners[0][near].min(axis=0) - MARGIN_M, corners[1][near].max(axis=0) + MARGIN_M
    window = []
    for side, end in enumerate(ends):
        begin, until = max(float(low[side]), 0.0), min(float(high[side]), end)
        window.append((0.0, end) if until - begin > WORTH_A_WINDOW * end else (begin, until))
    return window


def _places_at(plan: FleetPlan, pair: tuple[str, str], time: Floats | float) -> list[Floats]:
    """How far the two are at a time [m]."""
    return [np.asarray(plan.plans[name].trajectory.distance_at(time)) for name in pair]


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
