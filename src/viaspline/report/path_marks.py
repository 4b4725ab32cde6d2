"""What is drawn on top of a world: paths with arrows, via points, stations, the tightest place.

Tested through ``report/test_pictures``.
"""

from __future__ import annotations

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patheffects import Normal, Stroke

from viaspline.curve.certificate import Certificate
from viaspline.kernels.arrays import Floats
from viaspline.machine.drivability import Drivability
from viaspline.report import style
from viaspline.report.labels import Labels
from viaspline.report.profile_strips import radius_words
from viaspline.report.units import down

ARROW_SPACING_PX = 105.0  # pixels from one arrow to the next


def draw_path(
    axes: Axes,
    points: Floats,
    *,
    colour: str = style.PATH,
    label: str = "path",
    zorder: float = 8,
) -> Line2D:
    """A curve with a white edge, so that it stands out from what it crosses."""
    edge = Stroke(linewidth=style.PATH_WIDTH_PT + 1.6, foreground="white", alpha=0.85)
    (line,) = axes.plot(
        *points.T, color=colour, linewidth=style.PATH_WIDTH_PT, zorder=zorder, label=label,
        solid_capstyle="round", scalex=False, scaley=False, path_effects=[edge, Normal()],
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


def draw_tightest(axes: Axes, labels: Labels, certificate: Certificate) -> list[Artist]:
    """A ring around the tightest place, with its figure."""
    if certificate.obstacle is None:
        return []
    x, y = certificate.tightest_at[:2]
    (ring,) = axes.plot(
        x, y, marker="o", markersize=style.AROUND_PT, markerfacecolor="none",
        markeredgecolor=style.TIGHTEST, markeredgewidth=1.6, linestyle="none",
        zorder=style.AROUND_MARKS, label="tightest place",
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
    if drive.sharpest is not None:
        at = drive.sharpest.at[0], drive.sharpest.at[1]
        handles += mark_sharpest(axes, labels, at, drive.sharpest_radius)
    look = {"markerfacecolor": "none", "markeredgecolor": style.SHARPEST, "linestyle": "none"}
    if drive.turns_on_spot:
        places = np.array([turn.place.at[:2] for turn in drive.turns_on_spot])
        handles += axes.plot(
            *places.T, marker="D", markersize=13, markeredgewidth=1.2, zorder=style.AROUND_MARKS,
            label="turn on the spot", **look,  # type: ignore[arg-type]
        )  # fmt: skip
    return handles


def mark_sharpest(
    axes: Axes, labels: Labels, at: tuple[float, float], radius: float
) -> list[Artist]:
    """A square around the sharpest place [m], with its radius [m].

    Returns:
        What belongs in a legend.
    """
    labels.add(radius_words(radius), at, rank=2, colour=style.SHARPEST, gap=14)
    return [*axes.plot(
        *at, marker="s", markersize=style.AROUND_PT, markeredgewidth=1.5,
        zorder=style.AROUND_MARKS, markerfacecolor="none", markeredgecolor=style.SHARPEST,
        linestyle="none", label="sharpest place", scalex=False,
        scaley=False,
    )]  # fmt: skip


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
