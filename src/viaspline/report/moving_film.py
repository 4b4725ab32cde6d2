"""What moves in a film: shapes and velocity arrows, drawn anew for every frame.

Tested through ``report/test_moving_pictures``.
"""

from __future__ import annotations

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.patches import Rectangle

from viaspline.kernels.arrays import Floats
from viaspline.report import style
from viaspline.report.canvas import outline
from viaspline.report.moving_marks import shapes_and_arrows
from viaspline.world.moving_obstacles import MovingObstacles

HEAD_PX = 5.0  # of an arrow
BARB_RAD = 2.6  # between the way of an arrow and the barbs of its head


class MovingLayer:
    """The obstacles that move, as artists that a film places.

    Args:
        axes: Of the map.
        moving: What moves; nothing: there are no artists.
        pixels_per_metre: Of the map.
    """

    def __init__(self, axes: Axes, moving: MovingObstacles, pixels_per_metre: float) -> None:
        self._moving = moving
        self._head = HEAD_PX / pixels_per_metre
        self._shapes = PathCollection(
            [], facecolors=style.MOVING_FILL, edgecolors=style.MOVING, linewidths=0.9, zorder=20
        )
        self._arrows = LineCollection([], colors=style.MOVING, linewidths=1.3, zorder=21)
        self.artists: tuple[Artist, ...] = ()
        self.handles: tuple[Artist, ...] = ()
        if len(moving):
            axes.add_collection(self._shapes, autolim=False)
            axes.add_collection(self._arrows, autolim=False)
            self.artists = (self._shapes, self._arrows)
            self.handles = (
                Rectangle(
                    (0, 0), 1, 1, facecolor=style.MOVING_FILL, edgecolor=style.MOVING,
                    linewidth=0.9, label="moves; the arrow is a second's way",
                ),
            )  # fmt: skip

    def at(self, time: float) -> tuple[Artist, ...]:
        """The artists as at a time [s]."""
        if self.artists:
            shapes, arrows, _ = shapes_and_arrows(self._moving, time)
            self._shapes.set_paths([outline(shape) for shape in shapes])
            self._arrows.set_segments([arrow_line(arrow, self._head) for arrow in arrows])
        return self.artists


def arrow_line(arrow: Floats, head: float) -> Floats:
    """An arrow as one line.

    Args:
        arrow: x, y, dx, dy [m].
        head: Length of its barbs [m], at most half of its own.

    Returns:
        Shape (5, 2) [m].
    """
    begin, way = arrow[:2], arrow[2:]
    end, length = begin + way, float(np.hypot(*way))
    forward = way / length * min(head, 0.5 * length)
    c, s = np.cos(BARB_RAD), np.sin(BARB_RAD)
    left, right = (np.array([[c, -side * s], [side * s, c]]) @ forward for side in (1.0, -1.0))
    return np.array([begin, end, end + left, end, end + right])
