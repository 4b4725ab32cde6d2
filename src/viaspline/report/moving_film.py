"""What moves in a film: shapes and velocity arrows, drawn anew for every frame.

Tested through ``report/test_moving_pictures``.
"""

from __future__ import annotations

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.patches import Rectangle

from viaspline.report import style
from viaspline.report.canvas import outline
from viaspline.report.moving_marks import shapes_and_arrows
from viaspline.world.moving_obstacles import MovingObstacles


class MovingLayer:
    """The obstacles that move, as artists that a film places.

    Args:
        axes: Of the map.
        moving: What moves; nothing: there are no artists.
    """

    def __init__(self, axes: Axes, moving: MovingObstacles) -> None:
        self._moving = moving
        self._shapes = PathCollection(
            [], facecolors=style.MOVING_FILL, edgecolors=style.MOVING, linewidths=0.9, zorder=20
        )
        self._arrows = LineCollection([], colors=style.MOVING, linewidths=1.2, zorder=21)
        self.artists: tuple[Artist, ...] = ()
        self.handles: tuple[Artist, ...] = ()
        if len(moving):
            axes.add_collection(self._shapes, autolim=False)
            axes.add_collection(self._arrows, autolim=False)
            self.artists = (self._shapes, self._arrows)
            self.handles = (
                Rectangle(
                    (0, 0), 1, 1, facecolor=style.MOVING_FILL, edgecolor=style.MOVING,
                    linewidth=0.9, label="moves; the line is its way in a second",
                ),
            )  # fmt: skip

    def at(self, time: float) -> tuple[Artist, ...]:
        """The artists as at a time [s]."""
        if self.artists:
            shapes, arrows, _ = shapes_and_arrows(self._moving, time)
            self._shapes.set_paths([outline(shape) for shape in shapes])
            ends = np.stack((arrows[:, :2], arrows[:, :2] + arrows[:, 2:]), axis=1)
            self._arrows.set_segments(list(ends))
        return self.artists
