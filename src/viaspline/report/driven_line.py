"""The driven path on a map, in the colours of its speed, and where it is sharpest.

Tested through ``report/test_pictures``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from matplotlib import colormaps
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import Colormap, ListedColormap, Normalize
from matplotlib.legend_handler import HandlerBase
from matplotlib.lines import Line2D

from viaspline.kernels.arrays import Floats
from viaspline.report import style
from viaspline.robot.run import Run

DRIVEN: Final = "driven path"
MAX_LINE_PIECES: Final = 4000  # of the coloured line
KEY_PIECES: Final = 12  # of the line in a legend
STRAIGHT_1PM: Final = 1e-6  # [1/m]


@dataclass(frozen=True)
class SharpestDriven:
    """Where a driven path is sharpest.

    Attributes:
        at: The place [m].
        curvature: Without its sign [1/m]; infinite where the path turns back on the spot.
    """

    at: tuple[float, float]
    curvature: float

    @property
    def radius(self) -> float:
        """[m]."""
        return 1.0 / self.curvature


def sharpest_driven(run: Run) -> SharpestDriven | None:
    """Where a run is sharpest; None where it is straight.

    Of a robot without a drive that is the exact curve's place. One with a drive leaves a line of
    short pieces whose joints mean nothing: there it is what the robot says that it steers.
    """
    if run.tracking is None:
        curvature, u = run.path.max_curvature()
        at = np.asarray(run.path.evaluate(u))
    else:
        i = int(np.argmax(np.abs(run.curvatures)))
        curvature, at = abs(float(run.curvatures[i])), run.positions[i]
    if not curvature > STRAIGHT_1PM:
        return None
    return SharpestDriven((float(at[0]), float(at[1])), curvature)


class DrivenKey(HandlerBase):
    """The line of a legend for the driven path: all its colours, from slow to fast."""

    def create_artists(
        self, legend: Any, orig_handle: Any, xdescent: float, ydescent: float, width: float,
        height: float, fontsize: float, trans: Any,
    ) -> list[Artist]:  # fmt: skip
        """The artists; see ``HandlerBase``."""
        x = np.linspace(-xdescent, width - xdescent, KEY_PIECES + 1)
        y = np.full(KEY_PIECES + 1, 0.5 * height - ydescent)
        points = np.column_stack((x, y))
        colours = orig_handle.cmap(np.linspace(0.0, 1.0, KEY_PIECES))
        edge = Line2D(x, y, color=style.INK, linewidth=3.4, transform=trans)
        line = LineCollection(
            list(np.stack([points[:-1], points[1:]], axis=1)), colors=colours, linewidths=2.4,
            transform=trans,
        )  # fmt: skip
        return [edge, line]


def speed_colours(speeds: Floats) -> tuple[Colormap, Normalize]:
    """Colours from standing to full speed, dark enough for white paper at both ends."""
    whole = colormaps[style.SPEED_MAP]
    top = float(speeds.max()) if speeds.size else 0.0
    return ListedColormap(whole(np.linspace(0.0, 0.88, 256))), Normalize(0.0, max(top, 1e-3))


def thinned(points: Floats, most: int = MAX_LINE_PIECES) -> Floats:
    """At most so many of the points, the last one among them."""
    if len(points) <= most:
        return points
    kept: Floats = points[np.linspace(0, len(points) - 1, most).round().astype(int)]
    return kept


def draw_driven(
    axes: Axes, places: Floats, speeds: Floats, colours: Colormap, limits: Normalize,
    label: str = DRIVEN,
) -> Artist:  # fmt: skip
    """The driven path in the colours of its speed, with a dark edge.

    Args:
        axes: Where to.
        places: Along it [m], shape (n, 2) or more.
        speeds: There [m/s], shape (n,).
        colours: Of speeds,
        limits: from the slowest to the fastest.
        label: What a legend calls it.

    Returns:
        What belongs in a legend; ``DrivenKey`` shows it there.
    """
    points = thinned(places[:, :2])
    shown = thinned(speeds[:, None])[:, 0]
    axes.plot(
        *points.T, color=style.INK, linewidth=3.4, zorder=7.5, solid_capstyle="round",
        scalex=False, scaley=False,
    )  # fmt: skip
    pieces = LineCollection(
        list(np.stack([points[:-1], points[1:]], axis=1)), cmap=colours, norm=limits,
        linewidths=2.4, zorder=8, capstyle="round", label=label,
    )  # fmt: skip
    pieces.set_array((shown[:-1] + shown[1:]) / 2)
    axes.add_collection(pieces, autolim=False)
    return pieces
