"""``run.png`` of a fleet: what was driven beside what was planned, and how far apart."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes

from viaspline.fleet.execution.fleet_run import FleetRun
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.timelines import Timeline
from viaspline.report import style
from viaspline.report.canvas import any_name, png
from viaspline.report.fleet.driven_timelines import driven_timelines
from viaspline.report.fleet.fleet_colours import fleet_colours
from viaspline.report.fleet.fleet_map import draw_fleet_map, scene_of
from viaspline.report.fleet.fleet_page import SMALL_TALL, name_panel, new_fleet_page
from viaspline.report.fleet.fleet_picture import apart_words
from viaspline.report.fleet.places_over_time import FleetMotion, instants, span_of
from viaspline.report.fleet.separation_panel import draw_separation
from viaspline.report.fleet.waits_chart import draw_waits, rows_of
from viaspline.report.units import seconds

FEW = 60  # robots with large dots


@any_name()
def fleet_run_picture(plan: FleetPlan, run: FleetRun, name: str) -> bytes:
    """The picture as PNG.

    Args:
        plan: What was planned.
        run: What was driven.
        name: What the fleet is called.
    """
    scene, view = scene_of(plan)
    certificate = run.certificate
    begin, _ = span_of(plan)
    times = instants(begin, run.end_s, len(plan.plans), certificate.at_s)
    motion = FleetMotion.of_run(plan, run, times)
    timelines = driven_timelines(plan, run)
    rows = rows_of(timelines)
    colours = fleet_colours(list(plan.plans), plan.fleet, timelines, certificate)
    lines = (apart_words(certificate), _late_words(timelines, run))
    page = new_fleet_page(view, [SMALL_TALL + 0.5], len(rows), _title(plan, run, name), lines)
    draw_fleet_map(page.sheet, scene, plan, timelines, motion, colours)
    draw_waits(page.rows, rows, timelines, colours.of, (begin, run.end_s))
    _mark_planned(page.rows, plan, rows)
    page.apart.set_xlim(page.rows.get_xlim())
    draw_separation(page.apart, motion.nearest_two(), certificate)
    draw_arrivals(page.small[0], plan, run, colours.of)
    return png(page.sheet.figure)


def draw_arrivals(axes: Axes, plan: FleetPlan, run: FleetRun, colours: Mapping[str, str]) -> None:
    """When each robot arrived, over when it was planned to.

    Args:
        axes: Empty ones.
        plan: What was planned.
        run: What was driven.
        colours: Of robots by name.
    """
    name_panel(axes, "Arrivals, planned and driven")
    names = [name for name in plan.plans if name in run.arrivals]
    planned = np.array([plan.plans[name].trajectory.end_time for name in names])
    driven = np.array([run.arrivals[name] for name in names])
    top = 1.06 * max(float(planned.max(initial=1.0)), float(driven.max(initial=1.0)))
    axes.plot([0.0, top], [0.0, top], color=style.MUTED, linewidth=0.8, linestyle=(0, (4, 2)))
    inks = [colours[name] for name in names]
    area = 42.0 if len(names) <= FEW else 12.0
    axes.scatter(
        planned, driven, s=area, c=inks or None, edgecolors=style.INK, linewidths=0.5, zorder=3
    )
    axes.set_xlim(0.0, top)
    axes.set_ylim(0.0, top)
    axes.set_xlabel("planned [s]", labelpad=2)
    axes.set_ylabel("driven [s]", labelpad=2)


def _mark_planned(axes: Axes, plan: FleetPlan, rows: Sequence[Timeline]) -> None:
    """A stroke in each row at which its robot was planned to arrive."""
    ends = [plan.plans[one.name].trajectory.end_time for one in rows]
    places = np.arange(len(rows))
    axes.vlines(ends, places - 0.45, places + 0.45, color=style.INK, linewidth=1.4, zorder=4)
    words = axes.get_title(loc="left")
    name_panel(axes, f"{words}; strokes: planned arrivals")


def _title(plan: FleetPlan, run: FleetRun, name: str) -> str:
    count, asked = len(run.arrivals), len(plan.fleet.members)
    return f"{style.short(name, 48)}: {count} of {asked} robots arrived in {seconds(run.end_s)}"


def _late_words(timelines: Sequence[Timeline], run: FleetRun) -> str:
    when = "later" if run.mean_delay >= 0.0 else "sooner"
    words = f"{seconds(abs(run.mean_delay))} {when} than planned in the mean"
    if timelines and run.delays:
        worst = max(timelines, key=lambda one: one.late)
        words += f"; most of all {style.short(worst.name, 24)}, by {seconds(worst.late)}"
    swaps = sum(event.kind == "swapped" for event in run.events)
    swapped = f"; {swaps} orders swapped" if swaps else ""
    return f"{words}{swapped}"
