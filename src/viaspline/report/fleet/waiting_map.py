"""A map of waiting seconds: where robots lose time to each other.

Tested through ``report/fleet/test_fleet_picture``.
"""

from __future__ import annotations

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import ListedColormap

from viaspline.fleet.fleet_plan import FleetPlan
from viaspline.fleet.lost_times import lost_times
from viaspline.kernels.arrays import Floats
from viaspline.report.canvas import tidy
from viaspline.report.fleet.fleet_page import SMALL_TALL, name_panel
from viaspline.report.sheet import Box
from viaspline.report.style import MUTED

SQUARES = 44  # along the longer side of the view
SHOWN_S = 0.05  # of a square that isn't white


def waiting_seconds(plan: FleetPlan, view: Box) -> Floats:
    """How much time all robots together lose in squares of a view [s], rows from below."""
    lost = lost_times(plan).all
    size = max(view[2] - view[0], view[3] - view[1]) / SQUARES
    counts = [max(round((view[k + 2] - view[k]) / size), 1) for k in (1, 0)]
    x, y = plan.courses.packed.place.T
    sums: Floats = np.histogram2d(
        y, x, bins=counts, range=[(view[1], view[3]), (view[0], view[2])], weights=lost
    )[0]
    return sums


def map_width(view: Box) -> float:
    """How wide the map is, with its colour bar [inch]."""
    across, up = view[2] - view[0], view[3] - view[1]
    return float(np.clip(SMALL_TALL * across / up, 1.2, 3.6)) + 0.7


def draw_waiting_map(axes: Axes, plan: FleetPlan, view: Box) -> None:
    """Draw it.

    Args:
        axes: Empty ones.
        plan: Of the fleet.
        view: What the map of the picture shows [m].
    """
    name_panel(axes, "Where time is lost [s, all robots together]")
    sums = waiting_seconds(plan, view)
    colours = ListedColormap(colormaps["magma_r"](np.linspace(0.12, 1.0, 256)))
    shown = axes.imshow(
        np.where(sums >= SHOWN_S, sums, np.nan), origin="lower", aspect="equal", cmap=colours,
        extent=(view[0], view[2], view[1], view[3]), interpolation="nearest", vmin=0.0,
        vmax=max(float(sums.max()), 1e-9),
    )  # fmt: skip
    axes.set_anchor("W")
    bar = axes.inset_axes((1.03, 0.0, 0.04, 1.0))
    axes.figure.colorbar(shown, cax=bar)
    tidy(bar)
    for spine in bar.spines.values():
        spine.set_color(MUTED)
