"""The panel of space and time: how far along the path the robot is when, and what is blocked then.

Tested through ``report/test_moving_pictures``.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from viaspline.kernels.arrays import Floats
from viaspline.report import style
from viaspline.report.space_time import SpaceTime

DEEPEST_M = 1e6  # inside of something, as far as a picture cares


def draw_space_time(axes: Axes, shown: SpaceTime, driven: Floats, free: Floats | None) -> None:
    """Draw what is blocked, what is driven through it, and what would be if nothing moved.

    Args:
        axes: Empty ones.
        shown: What is to be seen.
        driven: Distances along the path [m] and times [s], (n, 2).
        free: The same of what would be driven; None: it isn't drawn.
    """
    distances, times, gaps = shown.gaps()
    if (gaps < 0.0).any():
        room = np.maximum(gaps, -DEEPEST_M)
        axes.contourf(
            distances, times, room, levels=[-2.0 * DEEPEST_M, 0.0], colors=[style.MOVING_FILL]
        )
        axes.contour(distances, times, room, levels=[0.0], colors=style.MOVING, linewidths=0.7)
    if free is not None:
        axes.plot(*free.T, color=style.LOSER, linewidth=1.0, linestyle=(0, (5, 3)))
    axes.plot(*driven.T, color=style.PATH, linewidth=1.6)
    axes.set_xlim(0.0, max(shown.path.length, 1e-9))
    axes.set_ylim(shown.begin, shown.end)
