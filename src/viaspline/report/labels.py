"""Labels that keep off the path, the markers, each other and whatever else is drawn."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely
from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke
from matplotlib.text import Text
from matplotlib.textpath import text_to_path

from viaspline.kernels.arrays import Floats
from viaspline.report.box_sums import BoxSums
from viaspline.report.canvas import renderer_of
from viaspline.report.drawn_ink import STEP_PX, contrasts
from viaspline.report.label_layout import LEFT_OUT, LabelPlaces, least_cost_places
from viaspline.report.style import INK, SMALL_PT

_NEAR_RAD = np.radians([35, -35, 145, -145, 0, 180, 90, -90])
_FAR_RAD = np.radians([35, -35, 145, -145, 0, 180, 90, -90, 62, -62, 118, -118, 15, -15, 165, -165])
_REACHES_PX = (0.0, 6.0, 15.0, 27.0, 43.0, 66.0, 95.0, 130.0)
"""Beyond the gap, to the label's box [pixels]."""

MAX_LABELS = 80
FIRST_RANKS = 3  # all labels below this rank are asked for, of the others evenly many
LEFT_OUT_COST = 62.0  # less for higher ranks: a label that hides more than that is left out
LEADER_FROM_PX = 12.0
"""Beyond the gap: a label that is farther away gets a line to what it names [pixels]."""

LEADER_POINTS = 8
PLACES_ASIDE = 7  # of a label within an area
FACING_LEAST = 0.2
"""Of a direction's part along an axis, from which a label stands beside its thing that way."""

CURVE_CELL_PX = 4.0
BETWEEN_PX = 1.0
"""Free space about every label, to either side [pixels]."""

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
    area: shapely.Geometry | None
    is_only_within: bool = False


@dataclass(frozen=True)
class _Ground:
    """What labels are laid on, in pixels of the figure.

    Attributes:
        area: What they have to stay in, shape (4,).
        curve: The curves to keep off.
        dots: The markers to keep off.
        ink: Whatever is drawn.
        marker_size: Radius of a marker.
    """

    area: Floats
    curve: BoxSums
    dots: BoxSums
    ink: BoxSums
    marker_size: float

    def costs(self, boxes: Floats, beyond: Floats) -> Floats:
        """What it costs to put a label there, shape (k,).

        Args:
            boxes: Of the label, shape (k, 4).
            beyond: How far each is from its usual place.
        """
        wide = np.array([-1.0, -1.0, 1.0, 1.0])
        near = 4.0 * np.minimum(self.curve.within(boxes + 2.0 * wide), 10.0)
        covered = 12.0 * self.dots.within(boxes + self.marker_size * wide)
        return near + covered + np.minimum(0.1 * self.ink.within(boxes), 24.0) + beyond / 3.0


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
        area: shapely.Geometry | None = None,
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
            area: What it names, if that is a part of the ground [m]: the label goes anywhere in it
                where it fits, before it goes beside its place.
        """
        self._labels.append(_Label(text, at, rank, colour, size, inside, gap, area))

    def add_within(self, text: str, area: shapely.Geometry, *, rank: int, size: float) -> None:
        """Ask for a label that is left out where it doesn't fit within what it names.

        Args:
            text: One line or more.
            area: A polygon without holes that matter [m]: the label goes anywhere within its ring.
            rank: Lower ranks choose their place first.
            size: The size of the font [points].
        """
        x, y = shapely.get_coordinates(shapely.point_on_surface(area))[0].tolist()
        ring = shapely.Polygon(shapely.get_exterior_ring(area))
        self._labels.append(_Label(text, (x, y), rank, INK, size, 0.0, 0.0, ring, True))

    def place(self, lines: Floats, markers: Floats, marker_size: float = 9.0) -> None:
        """Put the labels where they hide least in all; one that has no free place is left out.

        Args:
            lines: Points of the curves to keep off [m], close together, shape (n, 2).
            markers: Centres of the markers to keep off [m], shape (k, 2).
            marker_size: Their radius [pixels].
        """
        frame = self._axes.get_window_extent()
        area = np.array([frame.x0 + 3, frame.y0 + 3, frame.x1 - 3, frame.y1 - 3])
        to_pixels = self._axes.transData.transform
        asked = [
            (label, anchor)
            for label in _most(sorted(self._labels, key=lambda item: item.rank))
            if _is_in(anchor := to_pixels(label.at), area)
        ]
        if not asked:
            return
        ground = _Ground(
            area,
            BoxSums.of_points(to_pixels(lines.reshape(-1, 2)), area, CURVE_CELL_PX),
            BoxSums.of_points(to_pixels(markers.reshape(-1, 2)), area, 1.0),
            BoxSums.of_image(*contrasts(self._axes), STEP_PX),
            marker_size,
        )
        to_choose = [
            (label, anchor, some)
            for label, anchor in asked
            if (some := self._choices(label, anchor, ground)) is not None
        ]
        chosen = least_cost_places([some for *_, some in to_choose], self._written())
        for (label, anchor, some), place in zip(to_choose, chosen, strict=True):
            if place != LEFT_OUT:
                box = some.boxes[place]
                self._draw(label, anchor, 0.5 * (box[:2] + box[2:]), some.leaders[place])

    def _choices(self, label: _Label, anchor: Floats, ground: _Ground) -> LabelPlaces | None:
        """Where a label may go; None where it has to be within what has no room for it."""
        size = self._measure(label)
        within = self._in_area(label, size, ground)
        if within is not None or label.is_only_within:
            return within
        return _places(label, anchor, size, self._room_on(label), ground)

    def _room_on(self, label: _Label) -> float:
        """Width of the thing that a label names, on the picture [pixels]."""
        x, y = label.at
        ends = self._axes.transData.transform([(x, y), (x + label.inside, y)])
        return float(ends[1, 0] - ends[0, 0])

    def _in_area(self, label: _Label, size: Floats, ground: _Ground) -> LabelPlaces | None:
        """The places of a label within what it names; None where it doesn't fit."""
        if label.area is None:
            return None
        outline = self._axes.transData.transform(shapely.get_coordinates(label.area))
        seen = shapely.intersection(shapely.Polygon(outline), shapely.box(*ground.area))
        if seen.is_empty:
            return None
        low, high = np.array(seen.bounds).reshape(2, 2)
        shares = np.linspace(0.0, 1.0, PLACES_ASIDE)[:, None]
        x, y = (low + size / 2 + shares * (high - low - size)).T
        middles = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
        boxes = np.hstack((middles - size / 2, middles + size / 2))
        fits = shapely.contains(seen, shapely.box(*boxes.T))
        if not fits.any():
            return None
        away = np.abs(middles - (low + high) / 2).sum(axis=1)
        costs = ground.costs(boxes, 0.05 * away)
        leaders = np.full((int(fits.sum()), LEADER_POINTS, 2), np.nan)
        return LabelPlaces(boxes[fits], costs[fits], leaders, _left_out(label))

    def _written(self) -> Floats:
        """The boxes of all texts that are on the axes already [pixels], shape (n, 4)."""
        renderer = renderer_of(self._axes.figure)
        texts = [text for text in self._axes.texts if text.get_visible() and text.get_text()]
        boxes = [text.get_window_extent(renderer).extents for text in texts]
        grown: Floats = np.array(boxes).reshape(-1, 4) + BETWEEN_PX * np.array([-1.0, -1, 1, 1])
        return grown

    def _measure(self, label: _Label) -> Floats:
        text = Text(
            0, 0, label.text, size=label.size, parse_math=False, linespacing=1.05,
            figure=self._axes.figure,
        )  # fmt: skip
        extent = text.get_window_extent(renderer_of(self._axes.figure))
        width = max(extent.width, _outlined_width(text, self._axes.figure.dpi))
        size: Floats = np.ceil(np.array([width, extent.height])) + 2.0 * BETWEEN_PX
        return size

    def _draw(self, label: _Label, anchor: Floats, middle: Floats, ends: Floats) -> None:
        to_metres = self._axes.transData.inverted().transform
        if np.isfinite(ends).all():
            line = to_metres(ends[[0, -1]])
            self._axes.plot(
                *line.T, color=label.colour, linewidth=0.6, alpha=0.7, zorder=19, scalex=False,
                scaley=False,
            )  # fmt: skip
        x, y = to_metres(middle)
        halo = [] if (middle == anchor).all() else [_HALO]  # on the thing itself it needs none
        self._axes.text(
            x, y, label.text, size=label.size, color=label.colour, ha="center", va="center",
            zorder=20, parse_math=False, linespacing=1.05, clip_on=True,
            path_effects=halo,
        )  # fmt: skip


def _outlined_width(text: Text, dpi: float) -> float:
    """How wide a text with a halo is [pixels].

    Its letters are drawn as outlines, which aren't fitted to whole pixels: they may be wider than
    those that an extent is of.
    """
    of_line = text_to_path.get_text_width_height_descent
    lines = text.get_text().split("\n")
    points = max(of_line(line, text.get_fontproperties(), False)[0] for line in lines)
    return float(points) * dpi / 72.0


def _most(labels: list[_Label]) -> list[_Label]:
    """The first labels, and as many of the others as there may be, evenly out of them."""
    first = [label for label in labels if label.rank < FIRST_RANKS]
    others = labels[len(first) :]
    room = max(MAX_LABELS - len(first), 0)
    if len(others) > room:
        others = [others[k * len(others) // room] for k in range(room)]
    return first + others


def _is_in(place: Floats, area: Floats) -> bool:
    return bool((place >= area[:2]).all() and (place <= area[2:]).all())


def _leaders(label: _Label, anchor: Floats, boxes: Floats) -> Floats:
    """Points of the lines from places (k, 4) to what is named there; not a number where near.

    Returns:
        Shape (k, l, 2).
    """
    near = np.clip(anchor, boxes[:, :2], boxes[:, 2:])
    distance = np.hypot(*(near - anchor).T)
    with np.errstate(divide="ignore", invalid="ignore"):
        begin = anchor + (near - anchor) * (label.gap / distance)[:, None]
    lines: Floats = np.linspace(begin, near, LEADER_POINTS, axis=1)
    lines[distance <= label.gap + LEADER_FROM_PX] = np.nan
    return lines


def _left_out(label: _Label) -> float:
    """What it costs to leave a label out."""
    return LEFT_OUT_COST - 4.0 * label.rank


def _around() -> tuple[Floats, Floats, Floats]:
    """Directions (k, 2), reaches and costs (k,) of the places around a thing."""
    ways, reaches, costs = [], [], []
    for reach in _REACHES_PX:
        for i, angle in enumerate(_NEAR_RAD if reach < 15.0 else _FAR_RAD):
            ways.append((np.cos(angle), np.sin(angle)))
            reaches.append(reach)
            costs.append(4.0 + reach + 0.8 * min(i, 8))
    return np.array(ways), np.array(reaches), np.array(costs)


_AROUND = _around()


def _places(
    label: _Label, anchor: Floats, size: Floats, room: float, ground: _Ground
) -> LabelPlaces:
    """All places of a label, with their costs: around what it names, or right on it."""
    ways, reaches, beyond = _AROUND
    lean = np.sign(np.where(np.abs(ways) < FACING_LEAST, 0.0, ways))
    usual = anchor + ways * (label.gap + reaches)[:, None] + lean * size / 2
    if label.inside > 0 and room > size[0]:
        usual, beyond = np.vstack((anchor, usual)), np.append(-20.0, beyond)
    kept = np.clip(usual, ground.area[:2] + size / 2, ground.area[2:] - size / 2)
    shifted = np.abs(kept - usual).sum(axis=1)
    boxes = np.hstack((kept - size / 2, kept + size / 2))
    costs = ground.costs(boxes, beyond + shifted)
    outside = (boxes[:, :2] < ground.area[:2] - 1) | (boxes[:, 2:] > ground.area[2:] + 1)
    costs[outside.any(axis=1)] = np.inf
    return LabelPlaces(boxes, costs, _leaders(label, anchor, boxes), _left_out(label))
