"""``fleet.png``: where a fleet drives, who waits for whom and when, how far apart they stay."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Final

from viaspline.fleet.fleet_certificate import FleetCertificate
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.timelines import Timeline, timelines_of
from viaspline.report import style
from viaspline.report.canvas import any_name, png
from viaspline.report.fleet.coordination_panel import draw_coordination, pair_to_show
from viaspline.report.fleet.fleet_colours import fleet_colours
from viaspline.report.fleet.fleet_map import draw_fleet_map, scene_of
from viaspline.report.fleet.fleet_page import SMALL_TALL, new_fleet_page
from viaspline.report.fleet.flown_scene import FlownScene, draw_flown
from viaspline.report.fleet.heights_panel import draw_heights
from viaspline.report.fleet.places_over_time import FleetMotion, instants, span_of
from viaspline.report.fleet.separation_panel import draw_separation
from viaspline.report.fleet.waiting_map import draw_waiting_map, map_width
from viaspline.report.fleet.waits_chart import draw_waits, rows_of
from viaspline.report.units import down, seconds

VIEW_WIDE: Final = 4.0
"""Of the view of a fleet in space in perspective [inch]."""
HEIGHTS_WIDE: Final = 4.6
"""Of the panel with its heights over time [inch]."""


@any_name()
def fleet_picture(plan: FleetPlan, name: str) -> bytes:
    """The picture as PNG.

    Args:
        plan: Of the fleet.
        name: What the fleet is called.
    """
    scene, view = scene_of(plan)
    timelines, motion = timelines_of(plan), motion_of(plan)
    rows = rows_of(timelines)
    colours = fleet_colours(list(plan.plans), plan.fleet, timelines, plan.certificate)
    pair = pair_to_show(plan)
    is_large = not colours.all_told
    flown = [VIEW_WIDE, HEIGHTS_WIDE] if isinstance(scene, FlownScene) else []
    small = [*flown, *([SMALL_TALL + 0.5] if pair else [])]
    small += [map_width(view)] if is_large else []
    page = new_fleet_page(view, small, len(rows), *heading(plan, timelines, name))
    draw_fleet_map(page.sheet, scene, plan, timelines, motion, colours)
    panels = list(page.small)
    if isinstance(scene, FlownScene):
        draw_flown(page.sheet.figure, panels.pop(0), scene, plan, colours.of)
        draw_heights(panels.pop(0), motion, colours.of)
    if pair:
        draw_coordination(panels.pop(0), plan, pair, colours.of)
    if is_large:
        draw_waiting_map(panels.pop(0), plan, view)
    draw_waits(page.rows, rows, timelines, colours.of, span_of(plan))
    page.apart.set_xlim(page.rows.get_xlim())
    draw_separation(page.apart, motion.nearest_two(), plan.certificate)
    return png(page.sheet.figure)


def motion_of(plan: FleetPlan) -> FleetMotion:
    """Where robots are all through a plan, and where two of them are nearest."""
    times = instants(*span_of(plan), len(plan.plans), plan.certificate.at_s)
    return FleetMotion.of_plan(plan, times)


def heading(
    plan: FleetPlan, timelines: Sequence[Timeline], name: str
) -> tuple[str, tuple[str, str]]:
    """Title and the lines below it."""
    count, asked = len(plan.plans), len(plan.fleet.members)
    begin, end = span_of(plan)
    robots = "robot" if asked == 1 else "robots"
    title = f"{style.short(name, 48)}: {count} of {asked} {robots} served in {seconds(end - begin)}"
    if plan.patrols is not None:
        title = f"{style.short(name, 48)}: {count} of {asked} {robots} served"
        title += f", {len(plan.patrols.begins)} for ever, every {seconds(plan.patrols.period)}"
    late = [max(one.late, 0.0) for one in timelines]
    alone = sum(plan.alone[one] for one in plan.plans)
    lines = (
        f"{seconds(sum(late))} late in all, {sum(late) / max(alone, 1e-9):.1%} over driving alone"
    )
    if sum(late) > 0.0:
        worst = max(timelines, key=lambda one: one.late)
        lines += f"; most of all {style.short(worst.name, 24)}, by {seconds(worst.late)}"
    return title, (apart_words(plan.certificate), lines)


def apart_words(certificate: FleetCertificate) -> str:
    """What is proven of the distance between robots, in a few words."""
    if certificate.pair is None or not math.isfinite(certificate.separation):
        return "no two robots to keep apart"
    first, second = (style.short(name, 24) for name in certificate.pair)
    kept = "proven: no two bodies nearer than" if certificate.holds else "NOT proven apart, only"
    return (
        f"{kept} {down(certificate.separation)} ({certificate.required:g} m asked): "
        f"{first} and {second} at {certificate.at_s:.1f} s"
    )
