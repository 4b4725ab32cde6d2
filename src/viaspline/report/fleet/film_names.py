"""Names beside robots that move: each on a side where it covers no other robot and no other name.

A name stays on its side as long as it can: what jumps from frame to frame can't be read.

Tested through ``report/fleet/test_fleet_film``.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, Literal, TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke
from matplotlib.text import Annotation

from viaspline.kernels.arrays import Floats
from viaspline.report import style
from viaspline.report.canvas import text_width

Side: TypeAlias = tuple[
    tuple[float, float], Literal["left", "center", "right"], Literal["bottom", "center", "top"]
]
"""Which way from the robot, and how the text stands there."""
SIDES: Final[tuple[Side, ...]] = (
    ((0.0, 1.0), "center", "bottom"), ((1.0, 0.0), "left", "center"),
    ((0.0, -1.0), "center", "top"), ((-1.0, 0.0), "right", "center"),
)  # fmt: skip
"""The first ones are better, where nothing is in the way."""
GAP_PX: Final = 2.0  # between a robot and its name
MOST_LETTERS: Final = 12


class FilmNames:
    """The names of some robots of a film.

    Args:
        axes: Of the map; drawn on by whoever draws ``texts``.
        names: Of robots, by their numbers.
        radii: Of all robots, as they are drawn [pixels], (n,).
    """

    def __init__(self, axes: Axes, names: Mapping[int, str], radii: Floats) -> None:
        self.texts = [_text(axes, style.short(name, MOST_LETTERS)) for name in names.values()]
        self._axes = axes
        self._robots = list(names)
        self._radii = radii
        self._sides = [0] * len(self._robots)
        tall = style.SMALL_PT * axes.figure.dpi / 72.0
        self._sizes = [np.array([text_width(text), tall]) for text in self.texts]

    def move(self, here: Floats) -> None:
        """Put the names beside the robots.

        Args:
            here: Where all robots are [m], (n, 2); not a number where one is gone.
        """
        centres = self._axes.transData.transform(here)
        placed: list[Floats] = []
        for k, robot in enumerate(self._robots):
            text, radius = self.texts[k], self._radii[robot]
            text.set_visible(bool(np.isfinite(centres[robot]).all()))
            if not text.get_visible():
                continue
            boxes = [_box(centres[robot], radius, side, self._sizes[k]) for side in range(4)]
            others = np.delete(np.arange(len(centres)), robot)
            covers = [_covered(box, centres[others], self._radii[others], placed) for box in boxes]
            if covers[self._sides[k]] > 0.0:
                self._sides[k] = int(np.argmin(covers))
            placed.append(boxes[self._sides[k]])
            self._put(text, here[robot], radius, self._sides[k])

    def _put(self, text: Annotation, place: Floats, radius: float, side: int) -> None:
        way, across, up = SIDES[side]
        points = 72.0 / self._axes.figure.dpi * (radius + GAP_PX)
        text.xy = (float(place[0]), float(place[1]))
        text.set_position((way[0] * points, way[1] * points))
        text.set_horizontalalignment(across)
        text.set_verticalalignment(up)


def _text(axes: Axes, words: str) -> Annotation:
    text = axes.annotate(
        words, (0.0, 0.0), (0.0, 0.0), size=style.SMALL_PT, textcoords="offset points",
        color=style.INK, zorder=27, parse_math=False,
        path_effects=[withStroke(linewidth=2.0, foreground="white")],
    )  # fmt: skip
    text.set_animated(True)
    return text


def _box(centre: Floats, radius: float, side: int, size: Floats) -> Floats:
    """The corners of a name on a side of its robot [pixels], (2, 2)."""
    way = np.array(SIDES[side][0])
    middle = centre + way * (radius + GAP_PX + 0.5 * size)
    return np.array([middle - 0.5 * size, middle + 0.5 * size])


def _covered(box: Floats, centres: Floats, radii: Floats, placed: list[Floats]) -> float:
    """How much of robots and of names a box covers [pixels]: how deep it reaches into them."""
    away = np.hypot(*(centres - np.clip(centres, box[0], box[1])).T)
    deep = float(np.nansum(np.maximum(radii - away, 0.0)))
    for other in placed:
        both = np.minimum(box[1], other[1]) - np.maximum(box[0], other[0])
        deep += float(both.min()) if (both > 0.0).all() else 0.0
    return deep
