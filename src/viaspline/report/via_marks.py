"""The points of a route on a map: numbered in order, with names; stations and detours.

Tested through ``report/test_via_marks``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from viaspline.curve.path import GUIDE, PathVia
from viaspline.kernels.arrays import Floats
from viaspline.mission.model import Mission
from viaspline.report import style
from viaspline.report.labels import Labels

MAX_NUMBERED = 80  # via points that have numbers
MIN_NUMBERED_SPACING_PX = 24.0  # pixels between via points, below which they lose their numbers
SAME_PLACE_PX = 2.0  # closer via points are one mark
MIN_ON_DISC_PX = 19.0  # from a disc with a number to the next
LETTERS_ON_DISC = 3  # more stand beside it


@dataclass(frozen=True)
class ViaMark:
    """What stands at one place of a map.

    Attributes:
        at: The place [m].
        kind: What a legend calls it.
        text: Its number, or those of all via points there.
        fill: Colour of the mark,
        ink: and of what is written on it.
    """

    at: tuple[float, float]
    kind: str
    text: str
    fill: str
    ink: str


def draw_vias(
    axes: Axes, labels: Labels, vias: Sequence[PathVia], mission: Mission
) -> tuple[list[Artist], Floats]:
    """Via points, numbered in order, with their names; stations and detours look different.

    Returns:
        What belongs in a legend, and the centres of the markers [m], shape (k, 2).
    """
    last = len(mission.route.via) + 1  # later laps come to the same places
    users = [via for via in vias if via.kind == "user" and (via.index or 0) <= last]
    detours = [via for via in vias if via.kind == "detour" and via.name != GUIDE]
    places = np.array([via.at[:2] for via in users]).reshape(-1, 2)
    numbered = _are_apart(axes, places)
    marks = via_marks(users, mission.route.closed, _places_on(axes, places))
    if numbered:
        _number(axes, labels, marks)
    named = dict(_own_names(mission))
    for number, via in enumerate(users):
        if mission.route.closed and number == len(users) - 1 and users[0].at == via.at:
            continue
        words = [style.short(named[number])] if number in named else []
        if via.dwell > 0:
            words.append(f"stops {via.dwell:g} s")
        if words:
            labels.add(", ".join(words), (via.at[0], via.at[1]), rank=3, gap=16)
    return _draw_marks(axes, marks, numbered) + _draw_detours(axes, detours), places


def draw_plain_vias(axes: Axes, vias: Sequence[PathVia], mission: Mission) -> None:
    """Via points as small marks without numbers or names."""
    users = [via for via in vias if via.kind == "user"]
    places = np.array([via.at[:2] for via in users]).reshape(-1, 2)
    _draw_marks(axes, via_marks(users, mission.route.closed, _places_on(axes, places)), False)
    _draw_detours(axes, [via for via in vias if via.kind == "detour" and via.name != GUIDE])


def via_marks(users: Sequence[PathVia], closed: bool, pixels: Floats) -> list[ViaMark]:
    """The marks of via points: those that lie on each other have one.

    Args:
        users: In the order of the route.
        closed: Whether the last one may be the first one again.
        pixels: Where they are on the picture, shape (n, 2).
    """
    looks = [_look(number, via, users, closed) for number, via in enumerate(users)]
    shown = [number for number, look in enumerate(looks) if look[0] != "closing"]
    groups: list[list[int]] = []
    for number in shown:
        near = (g for g in groups if np.hypot(*(pixels[g[0]] - pixels[number])) < SAME_PLACE_PX)
        group = next(near, None)
        if group is None:
            groups.append([number])
        else:
            group.append(number)
    marks = []
    for group in groups:
        kind, _, fill, ink = looks[group[0]]
        kinds = [looks[number][0] for number in group]
        if "start" in kinds and "goal" in kinds:
            kind = "start and goal"
        text = ",".join(looks[number][1] for number in group)
        x, y = users[group[0]].at[:2]
        marks.append(ViaMark((x, y), kind, text, fill, ink))
    return marks


def _places_on(axes: Axes, places: Floats) -> Floats:
    """Places [m] on a picture, in pixels of a large one."""
    pixels: Floats = axes.transData.transform(places) * (style.DPI / axes.figure.dpi)
    return pixels


def _number(axes: Axes, labels: Labels, marks: Sequence[ViaMark]) -> None:
    """Numbers on the marks; beside them where they are long or another one is near."""
    pixels = _places_on(axes, np.array([mark.at for mark in marks]))
    on_discs: list[int] = []
    for i, mark in enumerate(marks):
        apart = np.hypot(*(pixels[on_discs] - pixels[i]).T) if on_discs else np.array([np.inf])
        if len(mark.text) > LETTERS_ON_DISC or apart.min() < MIN_ON_DISC_PX:
            labels.add(mark.text.replace(",", ", "), mark.at, rank=3, gap=12)
            continue
        on_discs.append(i)
        axes.text(
            *mark.at, mark.text, size=6.5 if len(mark.text) < 3 else 5, color=mark.ink,
            ha="center", va="center_baseline", zorder=13, weight="bold", clip_on=True,
        )  # fmt: skip


def _draw_marks(axes: Axes, marks: Sequence[ViaMark], numbered: bool) -> list[Artist]:
    dots: dict[tuple[str, str], list[tuple[float, float]]] = {}
    for mark in marks:
        dots.setdefault((mark.kind, mark.fill), []).append(mark.at)
    handles: list[Artist] = []
    for (kind, colour), at in dots.items():
        is_end = kind in ("start", "goal", "start and goal")
        size = (11.5 if numbered else 4.5) + (1.0 if is_end else 0.0)
        marker = "s" if kind == "station" else "o"
        handles += axes.plot(
            *np.transpose(at), marker=marker, markersize=size if marker == "o" else size - 1,
            markerfacecolor=colour, markeredgecolor=style.INK,
            markeredgewidth=0.9 if numbered else 0.6, linestyle="none", zorder=12, label=kind,
        )  # fmt: skip
    return handles


def _draw_detours(axes: Axes, detours: Sequence[PathVia]) -> list[Artist]:
    if not detours:
        return []
    corners = np.array([via.at[:2] for via in detours])
    return [*axes.plot(
        *corners.T, marker="D", markersize=3.6 if len(corners) < 60 else 2.4,
        markerfacecolor=style.DETOUR, markeredgecolor=style.INK, markeredgewidth=0.5,
        linestyle="none", zorder=11, label="detour via point",
    )]  # fmt: skip


def _are_apart(axes: Axes, places: Floats) -> bool:
    """Whether there is room for numbers."""
    if not 0 < len(places) <= MAX_NUMBERED:
        return False
    pixels = _places_on(axes, places)
    gaps = np.hypot(*(pixels[:, None] - pixels[None]).transpose(2, 0, 1))
    gaps[gaps < SAME_PLACE_PX] = np.inf  # the same place twice has one mark
    close = int((gaps.min(axis=1) < MIN_NUMBERED_SPACING_PX).sum())
    return close <= 0.25 * len(places)


def _own_names(mission: Mission) -> list[tuple[int, str]]:
    """Names that the mission's author gave, with the place in the route."""
    points = [point for _, point in mission.route.points()]
    return [(i, point.name) for i, point in enumerate(points) if point.name is not None]


def _look(
    number: int, via: PathVia, users: Sequence[PathVia], closed: bool
) -> tuple[str, str, str, str]:
    """Kind, text, fill and ink of a via point's marker."""
    last = number == len(users) - 1
    if number == 0:
        return ("start and goal" if closed else "start"), "S", style.START, "white"
    if last and closed and users[0].at == via.at:
        return "closing", "", "", ""
    if last and not closed:
        return "goal", "G", style.GOAL, "white"
    if via.dwell > 0:
        return "station", str(number), style.STATION, style.INK
    return "via point", str(number), "white", style.INK
