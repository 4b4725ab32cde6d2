"""The map of a fleet's picture, with the legend of the whole page beside it.

Tested through ``report/fleet/test_fleet_picture``.
"""

from __future__ import annotations

import textwrap
from collections import Counter
from collections.abc import Sequence
from typing import Final

import numpy as np
from matplotlib.artist import Artist
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.timelines import Timeline
from viaspline.planning.problem.requirements import Requirements
from viaspline.report import style
from viaspline.report.fleet.fleet_colours import ROBOT_COLOURS, FleetColours
from viaspline.report.fleet.fleet_marks import (
    draw_ends,
    draw_paths,
    draw_stations,
    draw_wait_arrows,
    goal_of,
    name_robots,
    paths_of,
)
from viaspline.report.fleet.flown_scene import FlownScene
from viaspline.report.fleet.moving_of_fleet import draw_moving_of_fleet
from viaspline.report.fleet.places_over_time import FleetMotion
from viaspline.report.fleet.waits_chart import STANDS_COLOUR
from viaspline.report.labels import Labels
from viaspline.report.path_marks import draw_arrows
from viaspline.report.scene import Scene
from viaspline.report.sheet import Box, Sheet, view_of
from viaspline.report.side_column import SideColumn
from viaspline.world.world import World

NOTE_WIDTH: Final = 40  # letters of a line of the column
HEADS_PX: Final = 170.0  # from one head on a path to the next [pixels]


def draw_fleet_map(
    sheet: Sheet, scene: Scene | FlownScene, plan: FleetPlan, timelines: Sequence[Timeline],
    motion: FleetMotion, colours: FleetColours,
) -> None:  # fmt: skip
    """Draw the map and its column.

    Args:
        sheet: An empty one.
        scene: The world.
        plan: Whose paths are drawn.
        timelines: Who waits when.
        motion: Where the robots are meanwhile.
        colours: Of the robots.
    """
    handles = draw_fleet_on(sheet, scene, plan, timelines, motion, colours)
    column = SideColumn(sheet)
    column.legend([*handles, *_chart_keys(timelines)])
    why = [f"{one.name}: {one.reason}" for one in plan.not_served]
    column.notes("Not served", [line for words in why for line in textwrap.wrap(words, NOTE_WIDTH)])


def draw_fleet_on(
    sheet: Sheet, scene: Scene | FlownScene, plan: FleetPlan, timelines: Sequence[Timeline],
    motion: FleetMotion, colours: FleetColours,
) -> list[Artist]:  # fmt: skip
    """Draw a fleet's plan on the map of a sheet, of which nothing else is touched.

    Returns:
        What belongs in a legend.
    """
    members = plan.fleet.members
    labels = Labels(sheet.map)
    handles = scene.draw(sheet.map, sheet.pixels_per_metre)
    handles += draw_moving_of_fleet(sheet.map, labels, plan)
    paths = paths_of(plan)
    draw_paths(sheet.map, paths, colours)
    for path, (name, colour) in zip(paths, colours.of.items(), strict=True):
        if name in colours.told:
            draw_arrows(sheet.map, path, colour, every=HEADS_PX)
    marks, places = draw_ends(sheet.map, members, colours)
    marks += draw_stations(sheet.map, members)
    name_robots(labels, members, colours)
    scene.name(labels)
    arrows = draw_wait_arrows(sheet.map, labels, motion.place_at, timelines, colours)
    labels.place(np.vstack([*paths, np.zeros((0, 2))]), places, marker_size=5.0)
    return [*robot_keys(colours), *marks, *arrows, *handles]


def scene_of(plan: FleetPlan) -> tuple[Scene | FlownScene, Box]:
    """The world of a fleet, and the part of it that pictures show."""
    members = plan.fleet.members
    ends = [one.mission.route.start.at[:2] for one in members]
    ends += [goal_of(one) for one in members]
    seen = np.vstack([*paths_of(plan), np.array(ends).reshape(-1, 2)])
    if plan.is_spatial:
        flown = FlownScene.of(plan)
        return flown, view_of(seen, flown.stands.corners(), flown.stands.bounds, flown.widest)
    kept = [Requirements.of(one.mission, one.tracking_error) for one in plan.plans.values()]
    least = min((one.required for one in kept), default=0.0)
    scene = Scene.of(World.known(members[0].mission), least)
    return scene, view_of(seen, scene.corners, scene.box, max(least, 0.5))


def robot_keys(colours: FleetColours) -> list[Artist]:
    """The legend's lines of the robots, and of the kinds of those that aren't told apart."""
    lines: list[Artist] = [
        Line2D([], [], color=colours.of[name], linewidth=2.4, label=style.short(name, 24))
        for name in colours.told
    ]
    others = Counter(colour for name, colour in colours.of.items() if name not in colours.told)
    for colour, count in others.items():
        kinds = [kind for kind, its in colours.kinds.items() if its == colour]
        what = style.short(", ".join(kinds), 24) if len(colours.kinds) > 1 else "robots"
        words = f"{count} other {what}" if colours.told else f"{count} {what}"
        lines.append(Line2D([], [], color=colour, linewidth=1.6, label=words))
    return lines


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
