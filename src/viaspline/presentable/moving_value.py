"""Values that can be shown as they move.

Tested through ``report/notebook/test_moving_axes``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from viaspline.presentable.upper_doors import opened_for

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes


class MovingValue:
    """A value with ``animate()``."""

    __slots__ = ()

    def animate(
        self, ax: Axes | None = None, *, pace: float = 10.0, fps: float = 10.0
    ) -> FuncAnimation:
        """Show it as it moves, with matplotlib.

        Args:
            ax: Where to; see ``plot``.
            pace: How many times as fast as it was.
            fps: Pictures a second.

        Returns:
            The animation: keep it for as long as it is to run; ``save("run.gif")`` writes it, and
            ``to_jshtml()`` shows it in a notebook.

        Raises:
            GeometryError: When ``ax`` is no axes of matplotlib, a number isn't above 0, or that
                makes more than 3000 pictures.
        """
        film: FuncAnimation = opened_for("film", self)(self, ax, pace, fps)
        return film
