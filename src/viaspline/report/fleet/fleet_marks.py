"""A fleet on a map: paths, starts and goals, names, and arrows from who waits to whom.

Tested through ``report/fleet/test_fleet_picture``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D
from matplotlib.patches import FancyArrowPatch
from matplotlib.patheffects import Normal, Stroke

from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.timelines import ActivitySpan, Timeline
from viaspline.kernels.arrays import Floats
from viaspline.mission.fleet.fleet import FleetMember
from viaspline.report import style
from viaspline.report.canvas import polyline
from viaspline.report.fleet.fleet_colours import MAX_TOLD_APART, FleetColours
from viaspline.report.labels import Labels

PlaceAt: TypeAlias = Callable[[str, float], tuple[float, float]]
"""Where the robot of a name is at a time [s], in [m]."""

MAX_PLAIN = 60  # robots with wide lines and large markers
MAX_ARROWS = 40  # the longest waits
MAX_TOLD_WAITS = 12  # whose seconds are on the map
WORTH_AN_ARROW_S = 0.2
LEAST_ARROW_PX = 22.0
POINTS_OF_ALL = 200_000  # of all paths, at most


def paths_of(plan: FleetPlan) -> list[Floats]:
    """The robots' paths from above as points [m], each (k, 2), in the order of the plan."""
    spans = sum(len(one.path.spans) for one in plan.plans.values())
    each = int(np.clip(POINTS_OF_ALL // max(spans, 1), 6, 40))
    return [polyline(one.path.spans, each)[:, :2] for one in plan.plans.values()]


def draw_paths(axes: Axes, paths: Sequence[Floats], colours: FleetColours) -> None:
    """Each path in its robot's colour; those that aren't told apart are thin and below."""
    many = len(paths) > MAX_PLAIN
    named = list(zip(colours.of.items(), paths, strict=True))
    for is_told, width, order in ((False, 0.7 if many else 1.1, 6.5), (True, 1.6, 7)):
        some = [one for one in named if (one[0][0] in colours.told) == is_told]
        if not some:
            continue
        lines = LineCollection(
            [path for _, path in some], colors=[colour for (_, colour), _ in some],
            linewidths=width, alpha=0.95, zorder=order, capstyle="round",
        )  # fmt: skip
        if is_told:
            lines.set_path_effects([Stroke(linewidth=width + 1.2, foreground="white"), Normal()])
        axes.add_collection(lines, autolim=False)


def draw_ends(
    axes: Axes, members: Sequence[FleetMember], colours: FleetColours
) -> tuple[list[Artist], Floats]:
    """Starts as discs, goals as squares, in the robots' colours; those not served are crossed.

    Returns:
        What belongs in a legend, and the centres of the markers [m], (k, 2).
    """
    small = 5.0 if len(members) <= MAX_PLAIN else 2.6
    left = [one for one in members if one.name not in colours.of]
    handles: list[Artist] = [_key("o", "white", "start"), _key("s", "white", "goal")]
    places = np.zeros((0, 2))
    for is_told, size in ((False, small), (True, 8.0)):
        some = [
            one for one in members
            if one.name in colours.of and (one.name in colours.told) == is_told
        ]  # fmt: skip
        starts = np.array([one.mission.route.start.at[:2] for one in some]).reshape(-1, 2)
        goals = np.array([goal_of(one) for one in some]).reshape(-1, 2)
        inks = [colours.of[one.name] for one in some]
        edge: dict[str, Any] = {"edgecolors": style.INK, "linewidths": 0.8 if size > 3 else 0.3}
        _scatter(axes, goals, size**2, inks, marker="s", **edge)
        _scatter(axes, starts, size**2, ["white"] * len(some), marker="o", **edge)
        _scatter(axes, starts, 0.4 * size**2, inks, marker="o", linewidths=0.0)
        places = np.vstack([places, starts, goals])
    if left:
        stuck = np.array([one.mission.route.start.at[:2] for one in left])
        crossed = [style.TIGHTEST] * len(left)
        area = 1.6 * (8.0 if len(members) <= MAX_TOLD_APART else small) ** 2
        _scatter(axes, stuck, area, crossed, marker="X", edgecolors="white", linewidths=0.7)
        handles.append(_key("X", style.TIGHTEST, f"not served: {len(left)}"))
        places = np.vstack([places, stuck])
    return handles, places


def draw_stations(axes: Axes, members: Sequence[FleetMember]) -> list[Artist]:
    """The places where robots stop on their way; returns what belongs in a legend."""
    stops = [via.at[:2] for one in members for via in one.mission.route.via if via.dwell_s > 0.0]
    if not stops:
        return []
    size = 5.5 if len(members) <= MAX_TOLD_APART else 2.5
    look: dict[str, Any] = {
        "marker": "D", "markersize": size, "markerfacecolor": style.STATION, "linestyle": "none",
        "markeredgecolor": style.INK, "markeredgewidth": 0.6,
    }  # fmt: skip
    return axes.plot(*np.array(stops).T, zorder=10, label="station", **look)  # type: ignore[return-value]


def goal_of(member: FleetMember) -> tuple[float, float]:
    """Where a robot's route ends [m]."""
    route = member.mission.route
    if route.land is not None:
        return route.land.at
    end = route.goal or (route.via[-1] if route.via and not route.closed else route.start)
    return end.at[0], end.at[1]


def name_robots(labels: Labels, members: Sequence[FleetMember], colours: FleetColours) -> None:
    """Ask for the names of robots at their starts: of those that colours tell apart.

    Those that aren't served are named as well where all are.
    """
    for one in members:
        if one.name not in colours.told and (one.name in colours.of or not colours.all_told):
            continue
        x, y = one.mission.route.start.at[:2]
        colour = colours.of.get(one.name, style.TIGHTEST)
        labels.add(style.short(one.name, 16), (x, y), rank=2, colour=colour, gap=8)


def draw_wait_arrows(
    axes: Axes, labels: Labels, place_at: PlaceAt, timelines: Sequence[Timeline],
    colours: FleetColours,
) -> list[Artist]:  # fmt: skip
    """Arrows from where a robot waits to where the other one passes before it.

    Args:
        axes: Of the map.
        labels: Takes how long the longest waits are.
        place_at: Where a robot is at a time.
        timelines: Who waits when.
        colours: Of the robots.

    Returns:
        What belongs in a legend.
    """
    waits = longest_waits(timelines)
    for rank, (name, wait) in enumerate(waits):
        when = 0.5 * (wait.begin + wait.end)
        tail = place_at(name, when)
        head = place_at(wait.other, wait.end)
        _draw_arrow(axes, tail, head)
        axes.plot(
            *tail,
            marker="o",
            markersize=5.0,
            markerfacecolor=colours.of[name],
            zorder=13.5,
            markeredgecolor=style.INK,
            markeredgewidth=0.8,
            linestyle="none",
        )
        if rank < MAX_TOLD_WAITS and name in colours.told:
            labels.add(f"{wait.lost:.1f} s", tail, rank=4, colour=colours.of[name], gap=7)
    if not waits:
        return []
    words = "waits for"
    if sum(len(one.waits) for one in timelines) > len(waits):
        words = f"waits for; the {len(waits)} longest"
    return [Line2D([], [], color=style.INK, marker=">", markersize=5, linewidth=1.1, label=words)]


def longest_waits(timelines: Sequence[Timeline]) -> list[tuple[str, ActivitySpan]]:
    """The longest waits of a fleet, each with who waits, the longest first."""
    there = {one.name for one in timelines}
    waits = [
        (one.name, wait)
        for one in timelines
        for wait in one.waits
        if wait.lost >= WORTH_AN_ARROW_S and wait.other in there
    ]
    return sorted(waits, key=lambda one: -one[1].lost)[:MAX_ARROWS]


def _draw_arrow(axes: Axes, tail: tuple[float, float], head: tuple[float, float]) -> None:
    """An arrow that can be seen: a short one is drawn longer, from farther back."""
    ends = axes.transData.transform([tail, head])
    way = ends[1] - ends[0]
    length = float(np.hypot(*way))
    if length < 1e-6:
        return
    if length < LEAST_ARROW_PX:
        ends[0] = ends[1] - way / length * LEAST_ARROW_PX
    start, end = (tuple(p) for p in axes.transData.inverted().transform(ends))
    axes.add_patch(
        FancyArrowPatch(
            start, end, arrowstyle="-|>", mutation_scale=10, color=style.INK, linewidth=1.1,
            connectionstyle="arc3,rad=0.18", zorder=13, shrinkA=0, shrinkB=0,
            path_effects=[Stroke(linewidth=2.6, foreground="white"), Normal()],
        )
    )  # fmt: skip


def _scatter(axes: Axes, places: Floats, area: float, inks: Sequence[str], **look: Any) -> None:
    axes.scatter(*places.T, s=area, c=list(inks) or None, zorder=11, **look)  # type: ignore[misc]


def _key(marker: str, colour: str, label: str) -> Line2D:
    return Line2D(
        [], [], marker=marker, markersize=8, markerfacecolor=colour, markeredgecolor=style.INK,
        markeredgewidth=0.8, linestyle="none", label=label,
    )  # fmt: skip
