"""What is drawn on top of a world: paths with arrows, via points, stations, the tightest place.

Tested through ``report/test_pictures``.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patheffects import Normal, Stroke

from viaspline.curve.certificate import Certificate
from viaspline.curve.path import GUIDE, PathVia
from viaspline.kernels.arrays import Floats
from viaspline.machine.drivability import Drivability
from viaspline.mission.model import Mission
from viaspline.report import style
from viaspline.report.labels import Labels
from viaspline.report.units import down, metres

MIN_NUMBERED_SPACING_PX = 24.0  # pixels between via points, below which they lose their numbers
ARROW_SPACING_PX = 105.0  # pixels from one arrow to the next


def draw_path(
    axes: Axes, points: Floats, *, colour: str = style.PATH, width: float = style.PATH_WIDTH_PT,
    label: str = "path", zorder: float = 8, **look: object,
) -> Line2D:  # fmt: skip
    """A curve with a white edge, so that it stands out from what it crosses."""
    (line,) = axes.plot(
        *points.T, color=colour, linewidth=width, zorder=zorder, label=label,
        solid_capstyle="round", scalex=False, scaley=False,
        path_effects=[Stroke(linewidth=width + 1.6, foreground="white", alpha=0.85), Normal()],
        **look,  # type: ignore[arg-type]
    )  # fmt: skip
    return line


def draw_arrows(
    axes: Axes,
    points: Floats,
    colour: str,
    *,
    avoid: Floats | None = None,
    every: float = ARROW_SPACING_PX,
) -> None:
    """Small arrow heads along a curve, which say which way it runs."""
    pixels = axes.transData.transform(points)
    steps = np.hypot(*np.diff(pixels, axis=0).T)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    count = min(int(along[-1] // every), 80)
    if count < 1 or not np.isfinite(along[-1]):
        return
    dots = np.zeros((0, 2)) if avoid is None or not len(avoid) else axes.transData.transform(avoid)
    heads = []
    for distance in (np.arange(count) + 0.5) * along[-1] / count:
        i = min(int(np.searchsorted(along, distance, side="right")) - 1, len(steps) - 1)
        if steps[i] <= 0:
            continue
        way = (pixels[i + 1] - pixels[i]) / steps[i]
        middle = pixels[i] + way * (distance - along[i])
        if len(dots) and np.hypot(*(dots - middle).T).min() < 17:
            continue
        across = np.array([-way[1], way[0]])
        heads.append([middle + 8.5 * way, middle - 5 * way + 6 * across, middle - 2.5 * way,
                      middle - 5 * way - 6 * across])  # fmt: skip
    if heads:
        shape = axes.transData.inverted().transform(np.array(heads).reshape(-1, 2))
        axes.add_collection(
            PolyCollection(
                list(shape.reshape(-1, 4, 2)), facecolors=colour, edgecolors="white",
                linewidths=0.6, zorder=9,
            ),
            autolim=False,
        )  # fmt: skip


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
    handles: list[Artist] = []
    dots: dict[tuple[str, str], list[tuple[float, ...]]] = {}
    named = dict(_own_names(mission))
    for number, via in enumerate(users):
        kind, text, colour, ink = _look(number, via, users, mission.route.closed)
        if kind == "closing":
            continue
        dots.setdefault((kind, colour), []).append(via.at[:2])
        if numbered:
            axes.text(
                via.at[0], via.at[1], text, size=6.5 if len(text) < 3 else 5, color=ink,
                ha="center", va="center_baseline", zorder=13, weight="bold", clip_on=True,
            )  # fmt: skip
        words = [style.short(named[number])] if number in named else []
        if via.dwell > 0:
            words.append(f"stops {via.dwell:g} s")
        if words:
            labels.add(", ".join(words), (via.at[0], via.at[1]), rank=3, gap=16)
    for (kind, colour), at in dots.items():
        size = (11.5 if numbered else 4.5) + (1.0 if kind in ("start", "goal") else 0.0)
        marker = "s" if kind == "station" else "o"
        handles += axes.plot(
            *np.transpose(at), marker=marker, markersize=size if marker == "o" else size - 1,
            markerfacecolor=colour, markeredgecolor=style.INK,
            markeredgewidth=0.9 if numbered else 0.6, linestyle="none", zorder=12, label=kind,
        )  # fmt: skip
    corners = np.array([via.at[:2] for via in detours]).reshape(-1, 2)
    if len(corners):
        (dot,) = axes.plot(
            *corners.T, marker="D", markersize=3.6 if len(corners) < 60 else 2.4,
            markerfacecolor=style.DETOUR, markeredgecolor=style.INK, markeredgewidth=0.5,
            linestyle="none", zorder=11, label="detour via point",
        )  # fmt: skip
        handles.append(dot)
    return handles, places


def _are_apart(axes: Axes, places: Floats) -> bool:
    """Whether there is room for numbers."""
    if len(places) > 80:
        return False
    pixels = axes.transData.transform(places)
    gaps = np.hypot(*(pixels[:, None] - pixels[None]).transpose(2, 0, 1))
    gaps[gaps == 0] = np.inf  # the same place twice
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


def draw_tightest(axes: Axes, labels: Labels, certificate: Certificate) -> list[Artist]:
    """A ring around the tightest place, with its figure."""
    if certificate.obstacle is None:
        return []
    x, y = certificate.tightest_at[:2]
    (ring,) = axes.plot(
        x, y, marker="o", markersize=11, markerfacecolor="none", markeredgecolor=style.TIGHTEST,
        markeredgewidth=1.6, linestyle="none", zorder=14, label="tightest place",
    )  # fmt: skip
    labels.add(
        f"{down(certificate.clearance)} clear", (x, y), rank=1, colour=style.TIGHTEST, gap=14
    )
    return [ring]


def draw_sharpest(axes: Axes, labels: Labels, drive: Drivability) -> list[Artist]:
    """A square around the sharpest place, with its radius; turns on the spot with their angles.

    Returns:
        What belongs in a legend.
    """
    handles: list[Artist] = []
    look = {"markerfacecolor": "none", "markeredgecolor": style.SHARPEST, "linestyle": "none"}
    if drive.sharpest is not None:
        x, y = drive.sharpest.at[:2]
        handles += axes.plot(
            x, y, marker="s", markersize=12, markeredgewidth=1.5, zorder=14,
            label="sharpest place", **look,  # type: ignore[arg-type]
        )  # fmt: skip
        text = f"radius {metres(drive.sharpest_radius, 2 if drive.sharpest_radius > 0.1 else 3)}"
        labels.add(text, (x, y), rank=2, colour=style.SHARPEST, gap=14)
    if drive.turns_on_spot:
        places = np.array([turn.place.at[:2] for turn in drive.turns_on_spot])
        handles += axes.plot(
            *places.T, marker="D", markersize=13, markeredgewidth=1.2, zorder=13,
            label="turn on the spot", **look,  # type: ignore[arg-type]
        )  # fmt: skip
    return handles


def draw_echoes(axes: Axes, points: Floats, size: float = 2.2) -> list[Artist]:
    """What a lidar has shown, as dots [m], shape (n, 2).

    Returns:
        What belongs in a legend.
    """
    if not len(points):
        return []
    look = {"marker": ".", "color": style.UNSEEN, "markeredgewidth": 0, "linestyle": "none"}
    axes.plot(*points.T, markersize=size, zorder=5, scalex=False, scaley=False, **look)  # type: ignore[arg-type]
    return [Line2D([], [], markersize=5, label="seen by the lidar", **look)]  # type: ignore[arg-type]
