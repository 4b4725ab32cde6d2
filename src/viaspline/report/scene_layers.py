"""The layers that a scene is drawn in: what lies outside, maps, known and unseen obstacles.

Tested through ``report/test_pictures``.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.patches import PathPatch, Rectangle
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from viaspline.report import style
from viaspline.report.canvas import outline
from viaspline.report.map_ground import UNKNOWN_LABEL, MapGround
from viaspline.report.sheet import Box

MAX_OBSTACLES_NAMED = 30  # on one picture; more are counted


def draw_outside(axes: Axes, view: Box, free: BaseGeometry, name: str) -> list[Artist]:
    """Shade what lies outside of the free area, and draw its edge, which the legend names."""
    far = max(view[2] - view[0], view[3] - view[1])
    outside = shapely.box(*grown(view, far)).difference(free)
    axes.add_artist(
        PathPatch(outline(outside), facecolor=style.OUTSIDE, edgecolor="none", zorder=0)
    )
    edge = PathPatch(
        outline(free), facecolor="none", edgecolor=style.INK, linewidth=1.0, zorder=2,
        label=name,
    )  # fmt: skip
    axes.add_artist(edge)
    return [edge]


def draw_grids(axes: Axes, grids: Sequence[MapGround]) -> list[Artist]:
    """The first on top; each kind has one entry in the legend."""
    handles: dict[str, Artist] = {}
    for i, ground in enumerate(grids):
        for handle in ground.draw(axes, zorder=2.4 - 0.01 * i):
            handles.setdefault(str(handle.get_label()), handle)
    unknown = handles.pop(UNKNOWN_LABEL, None)
    return [*handles.values(), *([] if unknown is None else [unknown])]


def draw_known(axes: Axes, shapes: NDArray[np.object_], scale: float, label: str) -> Artist:
    """The obstacles on the map, at so many pixels a metre; what belongs in a legend."""
    sizes = np.sqrt(shapely.area(shapes)) * scale
    width = 0.8 if np.median(sizes) > 8 else 0.3
    axes.add_collection(
        PathCollection(
            [outline(shape) for shape in shapes], facecolors=style.OBSTACLE,
            edgecolors=style.OBSTACLE_EDGE, linewidths=width, zorder=2.5,
        ),
        autolim=False,
    )  # fmt: skip
    return Rectangle(
        (0, 0), 1, 1, facecolor=style.OBSTACLE, edgecolor=style.OBSTACLE_EDGE, linewidth=0.8,
        label=label,
    )  # fmt: skip


def draw_unseen(axes: Axes, shapes: NDArray[np.object_], number: int, faint: bool) -> Artist:
    """Obstacles off the map, of so many in all; what belongs in a legend."""
    look = {"facecolor": style.UNSEEN_FILL, "edgecolor": style.UNSEEN, "hatch": "////"}
    if faint:
        look = {"facecolor": style.FAINT_FILL, "edgecolor": style.FAINT, "hatch": ""}
    width = 0.5 if faint else 0.9
    axes.add_collection(
        PathCollection(
            [outline(shape) for shape in shapes], facecolors=look["facecolor"],
            edgecolors=look["edgecolor"], hatch=look["hatch"], linewidths=width, zorder=2.6,
        ),
        autolim=False,
    )  # fmt: skip
    many = number > MAX_OBSTACLES_NAMED
    label = f"{number} obstacles, none on the map" if many else "obstacle that was not on the map"
    return Rectangle(
        (0, 0), 1, 1, facecolor=look["facecolor"], edgecolor=look["edgecolor"],
        hatch=look["hatch"], linewidth=width, label=label,
    )  # fmt: skip


def counted(number: int, what: str) -> str:
    """So many that nobody wants to read their names are counted."""
    return f"{number} {what}s" if number > MAX_OBSTACLES_NAMED else what


def grown(view: Box, by: float) -> Box:
    """A box that is larger by as much on each side [m]."""
    return view[0] - by, view[1] - by, view[2] + by, view[3] + by
