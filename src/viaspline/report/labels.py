"""Labels that keep off the path, the markers and each other: a small greedy placer."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke
from matplotlib.text import Text

from viaspline.kernels.arrays import Floats
from viaspline.report.canvas import renderer_of
from viaspline.report.style import INK, SMALL_PT

_ANGLES_RAD = np.radians([35, -35, 145, -145, 0, 180, 90, -90])
_REACHES_PX = (0.0, 6.0, 15.0, 27.0, 43.0, 66.0)  # beyond the gap, to the label's box [pixels]
MAX_LABELS = 150
_HALO = withStroke(linewidth=2.2, foreground="white", alpha=0.9)


@dataclass(frozen=True)
class _Label:
    text: str
    at: tuple[float, float]
    rank: int
    colour: str
    size: float
    inside: float
    gap: float


class Labels:
    """Collects the labels of a map and places them when everything else is drawn."""

    def __init__(self, axes: Axes) -> None:
        self._axes = axes
        self._labels: list[_Label] = []

    def add(
        self,
        text: str,
        at: tuple[float, float],
        *,
        rank: int = 5,
        colour: str = INK,
        size: float = SMALL_PT,
        inside: float = 0.0,
        gap: float = 9.0,
    ) -> None:
        """Ask for a label.

        Args:
            text: One line or more.
            at: What it names [m].
            rank: Lower ranks choose their place first.
            colour: The colour of the text.
            size: The size of the font [points].
            inside: Width of the thing [m]: the label goes on it when it fits.
            gap: From its place to the label, at least [pixels].
        """
        self._labels.append(_Label(text, at, rank, colour, size, inside, gap))

    def place(self, lines: Floats, markers: Floats, marker_size: float = 9.0) -> None:
        """Put every label where it hides least; one that has no free place is left out.

        Args:
            lines: Points of the curves to keep off [m], close together, shape (n, 2).
            markers: Centres of the markers to keep off [m], shape (k, 2).
            marker_size: Their radius [pixels].
        """
        if not self._labels:
            return
        to_pixels = self._axes.transData.transform
        curve = _sparse(to_pixels(lines)) if len(lines) else np.zeros((0, 2))
        dots = to_pixels(markers) if len(markers) else np.zeros((0, 2))
        frame = self._axes.get_window_extent()
        area = np.array([frame.x0 + 3, frame.y0 + 3, frame.x1 - 3, frame.y1 - 3])
        taken: list[Floats] = []
        for label in sorted(self._labels, key=lambda item: item.rank)[:MAX_LABELS]:
            anchor = to_pixels(label.at)
            if not (area[0] <= anchor[0] <= area[2] and area[1] <= anchor[1] <= area[3]):
                continue
            size = self._measure(label)
            best = _best_place(
                label, anchor, size, area, curve, dots, marker_size, taken, to_pixels
            )
            if best is not None:
                self._draw(label, anchor, best, size)
                taken.append(_box(best, size))

    def _measure(self, label: _Label) -> Floats:
        text = Text(0, 0, label.text, size=label.size, parse_math=False, figure=self._axes.figure)
        extent = text.get_window_extent(renderer_of(self._axes.figure))
        return np.array([extent.width + 2, extent.height + 2])

    def _draw(self, label: _Label, anchor: Floats, middle: Floats, size: Floats) -> None:
        to_metres = self._axes.transData.inverted().transform
        gap = np.abs(middle - anchor) - size / 2
        distance = float(np.hypot(*np.maximum(gap, 0)))
        if distance > label.gap + 12:
            near = np.clip(anchor, middle - size / 2, middle + size / 2)
            ends = to_metres([anchor + (near - anchor) * label.gap / distance, near])
            self._axes.plot(*ends.T, color=label.colour, linewidth=0.6, alpha=0.7, zorder=19)
        x, y = to_metres(middle)
        halo = [] if (middle == anchor).all() else [_HALO]  # on the thing itself it needs none
        self._axes.text(
            x, y, label.text, size=label.size, color=label.colour, ha="center", va="center",
            zorder=20, parse_math=False, linespacing=1.05, clip_on=True,
            path_effects=halo,
        )  # fmt: skip


def _sparse(points: Floats) -> Floats:
    """One of the points for each square of four pixels."""
    return np.unique(np.round(points / 4), axis=0) * 4


def _box(middle: Floats, size: Floats) -> Floats:
    return np.concatenate([middle - size / 2, middle + size / 2])


def _inside(points: Floats, box: Floats, grow: float) -> int:
    if not len(points):
        return 0
    within = (points > box[:2] - grow) & (points < box[2:] + grow)
    return int(within.all(1).sum())


def _best_place(
    label: _Label, anchor: Floats, size: Floats, area: Floats, curve: Floats, dots: Floats,
    marker_size: float, taken: list[Floats], to_pixels: object,
) -> Floats | None:  # fmt: skip
    best, lowest = None, 60.0
    boxes = np.array(taken).reshape(-1, 4)
    for cost, middle in _places(label, anchor, size, to_pixels):
        box = _box(middle, size)
        if (box[:2] < area[:2]).any() or (box[2:] > area[2:]).any():
            continue
        apart = (boxes[:, :2] > box[2:]) | (boxes[:, 2:] < box[:2])
        if not apart.any(1).all():
            continue
        cost += 4.0 * min(_inside(curve, box, 2.0), 10) + 12.0 * _inside(dots, box, marker_size)
        if cost < lowest:
            best, lowest = middle, cost
    return best


def _places(
    label: _Label, anchor: Floats, size: Floats, to_pixels: object
) -> list[tuple[float, Floats]]:
    assert callable(to_pixels)
    places: list[tuple[float, Floats]] = []
    if label.inside > 0:
        corners = to_pixels([label.at, (label.at[0] + label.inside, label.at[1])])
        if corners[1, 0] - corners[0, 0] > size[0]:
            places.append((0.0, anchor))
    for reach in _REACHES_PX:
        for i, angle in enumerate(_ANGLES_RAD):
            way = np.array([np.cos(angle), np.sin(angle)])
            lean = np.sign(np.where(np.abs(way) < 0.2, 0.0, way))
            places.append(
                (1.0 + reach / 4 + 0.2 * i, anchor + way * (label.gap + reach) + lean * size / 2)
            )
    return places
