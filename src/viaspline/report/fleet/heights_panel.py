"""How high each robot of a fleet in space is over time.

Tested through ``report/fleet/test_flying_fleet_picture``.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes

from viaspline.report import style
from viaspline.report.fleet.fleet_page import name_panel
from viaspline.report.fleet.places_over_time import FleetMotion


def draw_heights(axes: Axes, motion: FleetMotion, colours: Mapping[str, str]) -> None:
    """Draw it.

    Args:
        axes: Empty ones.
        motion: Where the robots are when, in space.
        colours: Of the robots by name.
    """
    name_panel(axes, "How high they fly [m]")
    axes.set_xlabel("time [s]", labelpad=2)
    if motion.heights is None or not motion.names:
        return
    for name, heights in zip(motion.names, motion.heights, strict=True):
        axes.plot(motion.times, heights, color=colours[name], linewidth=1.3)
    known = motion.heights[np.isfinite(motion.heights)]
    low, high = float(known.min()), float(known.max())
    margin = max(0.08 * (high - low), 0.5)
    axes.set_xlim(float(motion.times[0]), float(motion.times[-1]))
    axes.set_ylim(low - margin, high + margin)
    axes.grid(axis="y", color=style.OUTSIDE, linewidth=0.6)
    axes.set_axisbelow(True)
