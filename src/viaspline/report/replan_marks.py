"""The places at which new paths begin, on the map of a run."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes

from viaspline.kernels.arrays import Floats
from viaspline.report import style
from viaspline.report.labels import Labels
from viaspline.robot.run import Run

VIA_DISC_PX = 12.0
"""Nearer to the middle of a via point's disc a mark would hide its number [px]."""

USUAL, MANY, AROUND_VIA = 6.0, 4.0, 15.0
"""Sizes of the mark [pt]: on its own, where there are many, and around a via point."""


def draw_replans(axes: Axes, labels: Labels, run: Run, *, many: bool) -> list[Artist]:
    """A diamond where each new path begins; around a via point where one begins at it.

    Args:
        axes: The map.
        labels: Of the map.
        run: What was driven.
        many: Whether they are too many for labels, as with a lidar.

    Returns:
        What belongs in a legend; nothing where no path was laid anew.
    """
    vias = np.array([via.at[:2] for via in run.plan.path.vias if via.kind == "user"])
    handles: list[Artist] = []
    for replan in run.replans:
        around = not many and _nearest_px(axes, vias, replan.at) < VIA_DISC_PX
        size = MANY if many else AROUND_VIA if around else USUAL
        handles = [*axes.plot(
            *replan.at[:2], marker="D", markersize=size, linestyle="none",
            markerfacecolor="none" if around else "white", markeredgecolor=style.UNSEEN,
            markeredgewidth=min(0.23 * size, 1.6), zorder=10 if many else 14.5,
            label="new path from here",
        )]  # fmt: skip
        if not many:
            labels.add(
                f"new path, {replan.time:.0f} s ({replan.mode.replace('_', ' ')})",
                (replan.at[0], replan.at[1]), rank=4, colour=style.UNSEEN,
            )  # fmt: skip
    return handles


def _nearest_px(axes: Axes, places: Floats, at: Sequence[float]) -> float:
    """How far the nearest of some places [m], shape (n, 2), is from another on the page [px]."""
    pixels = axes.transData.transform(np.vstack([places, at[:2]]))
    return float(np.hypot(*(pixels[:-1] - pixels[-1]).T).min())
