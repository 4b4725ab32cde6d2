"""``fleet.png``: where a fleet drives, who waits for whom and when, how far apart they stay."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np
from matplotlib.artist import Artist
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from viaspline.fleet.fleet_certificate import FleetCertificate
from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.timelines import Timeline, timelines_of
from viaspline.planning.problem.requirements import Requirements
from viaspline.report import style
from viaspline.report.canvas import any_name, png
from viaspline.report.fleet.coordination_panel import draw_coordination, pair_to_show
from viaspline.report.fleet.fleet_colours import MAX_TOLD_APART, ROBOT_COLOURS, colours_of
from viaspline.report.fleet.fleet_marks import (
    draw_ends,
    draw_paths,
    draw_wait_arrows,
    goal_of,
    name_robots,
    paths_of,
)
from viaspline.report.fleet.fleet_motion import FleetMotion, NearestTwo, span_of
from viaspline.report.fleet.fleet_page import SMALL_TALL, new_fleet_page
from viaspline.report.fleet.separation_panel import draw_separation
from viaspline.report.fleet.waiting_map import draw_waiting_map
from viaspline.report.fleet.waits_chart import STANDS_COLOUR, draw_waits, rows_of
from viaspline.report.labels import Labels
from viaspline.report.path_marks import draw_arrows
from viaspline.report.scene import Scene
from viaspline.report.sheet import Box, view_of
from viaspline.report.side_column import SideColumn
from viaspline.report.units import down, seconds
from viaspline.world.world import World

INSTANTS: Final = 700  # at which the nearest two are looked for
NOTE_WIDTH: Final = 40  # letters of a line of the column
PLACES: Final = 700_000  # of all robots at all these instants, at most


@any_name()
def fleet_picture(plan: FleetPlan, name: str) -> bytes:
    """The picture as PNG.

    Args:
        plan: Of the fleet.
        name: What the fleet is called.
    """
    scene, view = scene_of(plan)
    timelines = timelines_of(plan)
    rows = rows_of(timelines)
    colours = dict(zip(plan.names, colours_of(len(plan.names)), strict=True))
    pair = pair_to_show(plan)
    is_large = len(plan.names) > MAX_TOLD_APART
    small = ([SMALL_TALL + 0.5] if pair else []) + ([_map_width(view)] if is_large else [])
    page = new_fleet_page(view, small, len(rows), *heading(plan, timelines, name))
    sheet, members = page.sheet, plan.fleet.members
    labels = Labels(sheet.map)
    handles = scene.draw(sheet.map, sheet.pixels_per_metre)
    paths = paths_of(plan)
    draw_paths(sheet.map, paths, list(colours.values()))
    if not is_large:
        for path, colour in zip(paths, colours.values(), strict=True):
            draw_arrows(sheet.map, path, colour, every=170.0)
    marks, places = draw_ends(sheet.map, members, colours)
    name_robots(labels, members, colours)
    arrows = draw_wait_arrows(sheet.map, labels, plan, timelines, colours)
    labels.place(np.vstack([*paths, np.zeros((0, 2))]), places, marker_size=5.0)
    column = SideColumn(sheet)
    column.legend(
        [*_robots(timelines, colours), *marks, *arrows, *handles, *_chart_keys(timelines)]
    )
    why = [f"{one.name}: {one.reason}" for one in plan.not_served]
    column.notes("Not served", [line for words in why for line in textwrap.wrap(words, NOTE_WIDTH)])
    panels = list(page.small)
    if pair:
        draw_coordination(panels.pop(0), plan, pair, colours)
    if is_large:
        draw_waiting_map(panels.pop(0), plan, view)
    span = span_of(plan)
    draw_waits(page.rows, rows, len(timelines), colours, span)
    page.apart.set_xlim(page.rows.get_xlim())
    draw_separation(page.apart, nearest_two_of(plan), plan.certificate)
    return png(sheet.figure)


def scene_of(plan: FleetPlan) -> tuple[Scene, Box]:
    """The world of a fleet, and the part of it that pictures show."""
    members = plan.fleet.members
    ends = [one.mission.route.start.at[:2] for one in members]
    ends += [goal_of(one) for one in members]
    seen = np.vstack([*paths_of(plan), np.array(ends).reshape(-1, 2)])
    kept = [Requirements.of(one.mission, one.tracking_error) for one in plan.plans.values()]
    least = min((one.required for one in kept), default=0.0)
    scene = Scene.of(World.known(members[0].mission), least)
    return scene, view_of(seen, scene.corners, scene.box, max(least, 0.5))


def nearest_two_of(plan: FleetPlan) -> NearestTwo:
    """How far apart the nearest two are, all through a plan and where they are nearest."""
    count = int(np.clip(PLACES // max(len(plan.names), 1), 100, INSTANTS))
    begin, end = span_of(plan)
    at = plan.certificate.at_s
    times = np.linspace(begin, end, count)
    if begin < at < end:
        times = np.unique(np.append(times, at))
    return FleetMotion.of_plan(plan, times).nearest_two()


def heading(
    plan: FleetPlan, timelines: Sequence[Timeline], name: str
) -> tuple[str, tuple[str, str]]:
    """Title and the lines below it."""
    count, asked = len(plan.plans), len(plan.fleet.members)
    begin, end = span_of(plan)
    robots = "robot" if asked == 1 else "robots"
    title = f"{style.short(name, 48)}: {count} of {asked} {robots} served in {seconds(end - begin)}"
    late = [max(one.late, 0.0) for one in timelines]
    alone = sum(plan.alone[one] for one in plan.names)
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


def _map_width(view: Box) -> float:
    """Of the map of waiting seconds, with its colour bar [inch]."""
    across, up = view[2] - view[0], view[3] - view[1]
    return float(np.clip(SMALL_TALL * across / up, 1.2, 3.6)) + 0.7


def _robots(timelines: Sequence[Timeline], colours: Mapping[str, str]) -> list[Artist]:
    """The legend's lines of the robots, as far as their colours tell them apart."""
    if len(timelines) > MAX_TOLD_APART:
        words = f"paths of {len(timelines)} robots"
        return [Line2D([], [], color=style.PATH, linewidth=1.6, label=words)]
    return [
        Line2D([], [], color=colours[one.name], linewidth=2.4, label=style.short(one.name, 24))
        for one in timelines
    ]


def _chart_keys(timelines: Sequence[Timeline]) -> list[Artist]:
    """What the bars of the chart mean."""
    own, other = ROBOT_COLOURS[0], ROBOT_COLOURS[1]
    looks: dict[str, Artist] = {
        "drives": Patch(facecolor=own, label="drives"),
        "waits": Patch(
            facecolor="white", edgecolor=other, hatch="/////", label="waits, slows for another"
        ),
        "stands": Patch(facecolor=STANDS_COLOUR, edgecolor=own, label="stands at a station"),
    }
    met = {stretch.kind for one in timelines for stretch in one.stretches}
    return [look for kind, look in looks.items() if kind in met]
