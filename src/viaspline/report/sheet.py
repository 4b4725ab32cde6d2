"""The page of a picture: a map at equal scales, strips below it, a column at its right.

Tested through ``report/test_pictures``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from viaspline.kernels.arrays import Floats
from viaspline.report.canvas import new_figure, tidy
from viaspline.report.proven_reference import PROVEN_WORDS, says_proven
from viaspline.report.style import DPI, INK, MUTED, SMALL_PT, TEXT_PT, TITLE_PT
from viaspline.report.units import nice

Box = tuple[float, float, float, float]  # x_min, y_min, x_max, y_max [m]

LEFT, RIGHT, TOP, BOTTOM = 0.85, 2.75, 1.2, 0.6  # margins [inch]; the right one is a column
STRIP, GAP = 0.95, 0.16
FOOT_PT = 6.0
"""Size of the line at the foot of the page."""
WIDEST, TALLEST, NARROWEST, LOWEST = 8.6, 7.4, 4.4, 2.4  # of the map [inch]


@dataclass(frozen=True)
class Sheet:
    """A page.

    Attributes:
        figure: The figure.
        map: The axes of the map; their limits are fixed.
        strips: The axes below, sharing the distance along the path.
        side: Left, bottom, width, height of the right column [inch].
        pixels_per_metre: The scale of the map.
    """

    figure: Figure
    map: Axes
    strips: tuple[Axes, ...]
    side: Box
    pixels_per_metre: float

    def fraction(self, left: float, bottom: float, width: float, height: float) -> Box:
        """A rectangle [inch] as fractions of the figure."""
        across, up = (float(size) for size in self.figure.get_size_inches())
        return left / across, bottom / up, width / across, height / up


def view_of(points: Floats, others: Floats, bounds: Box | None, margin: float) -> Box:
    """The part of the world that a picture shows.

    All of the route; the bounds when they are not much larger; else the obstacles when they are
    not much farther away.

    Args:
        points: What has to be seen [m], shape (n, 2).
        others: Corners of the boxes of the obstacles [m], shape (k, 2).
        bounds: The bounds of the world [m].
        margin: Least free space around it all [m].
    """
    low, high = points.min(0), points.max(0)
    size = max(float((high - low).max()), 6 * margin, 1e-6)
    if bounds is not None:
        span = max(bounds[2] - bounds[0], bounds[3] - bounds[1])
        if span <= 6 * size:
            low = np.minimum(low, bounds[:2]) - 0.025 * span
            high = np.maximum(high, bounds[2:]) + 0.025 * span
            return float(low[0]), float(low[1]), float(high[0]), float(high[1])
    elif len(others):
        near = np.minimum(low, others.min(0)), np.maximum(high, others.max(0))
        if float((near[1] - near[0]).max()) <= 2 * size:
            low, high = near
    grow = max(0.07 * float((high - low).max()), 2 * margin, 1e-6)
    return float(low[0] - grow), float(low[1] - grow), float(high[0] + grow), float(high[1] + grow)


def new_sheet(
    view: Box, strips: Sequence[str], title: str, subtitles: Sequence[str], *, dpi: int = DPI
) -> Sheet:
    """A page for a view, with one strip for each of the names."""
    across, up = view[2] - view[0], view[3] - view[1]
    scale = min(WIDEST / across, TALLEST / up)  # inch per metre
    width, height = max(across * scale, NARROWEST), max(up * scale, LOWEST)
    below = BOTTOM + (0.5 + len(strips) * (STRIP + GAP) if strips else 0.0)
    total_w, total_h = LEFT + width + RIGHT, below + height + TOP
    figure = new_figure(total_w, total_h, dpi)
    sheet_map = figure.add_axes(
        (LEFT / total_w, below / total_h, width / total_w, height / total_h)
    )
    middle = (view[0] + view[2]) / 2, (view[1] + view[3]) / 2
    sheet_map.set_xlim(middle[0] - width / scale / 2, middle[0] + width / scale / 2)
    sheet_map.set_ylim(middle[1] - height / scale / 2, middle[1] + height / scale / 2)
    sheet_map.set_xlabel("x, east [m]", labelpad=2)
    sheet_map.set_ylabel("y, north [m]", labelpad=2)
    tidy(sheet_map)
    below_map: list[Axes] = []
    for i, name in enumerate(strips):
        bottom = BOTTOM + (len(strips) - 1 - i) * (STRIP + GAP)
        rectangle = LEFT / total_w, bottom / total_h, width / total_w, STRIP / total_h
        strip = figure.add_axes(rectangle, sharex=below_map[0] if below_map else None)
        strip.set_ylabel(name, labelpad=2)
        tidy(strip)
        if i < len(strips) - 1:
            strip.tick_params(labelbottom=False)
        below_map.append(strip)
    figure.align_ylabels(below_map)
    draw_heading(figure, title, subtitles)
    side = LEFT + width + 0.25, 0.2, RIGHT - 0.45, total_h - TOP - 0.2
    sheet = Sheet(figure, sheet_map, tuple(below_map), side, scale * dpi)
    draw_scale_bar(sheet, scale, LEFT + width, total_h - TOP + 0.14)
    return sheet


def draw_heading(figure: Figure, title: str, subtitles: Sequence[str]) -> None:
    """Title and subtitles at the left of the page, small enough to fit on it.

    Where they say that something is proven, the foot of the page says what that covers.
    """
    across, up = (float(size) for size in figure.get_size_inches())
    canvas = figure.canvas
    assert isinstance(canvas, FigureCanvasAgg)
    for i, line in enumerate((title, *subtitles)):
        text = figure.text(
            LEFT / across, 1 - (0.3 + 0.26 * bool(i) + 0.2 * max(i - 1, 0)) / up, line,
            size=TEXT_PT if i else TITLE_PT, weight="normal" if i else "bold",
            color=MUTED if i else INK, va="center", parse_math=False,
        )  # fmt: skip
        width = text.get_window_extent(canvas.get_renderer()).width / figure.dpi  # type: ignore[no-untyped-call]
        room = across - LEFT - 0.25
        if width > room:
            text.set_fontsize((TEXT_PT if i else TITLE_PT) * room / width)
    if says_proven(subtitles):
        figure.text(
            1 - 0.12 / across, 0.09 / up, PROVEN_WORDS, size=FOOT_PT, color=MUTED, ha="right",
            va="center",
        )  # fmt: skip


def draw_scale_bar(sheet: Sheet, scale: float, right: float, bottom: float) -> None:
    """A bar above the right end of the map, where it hides nothing."""
    length = nice(0.9 / scale)
    inches = length * scale
    across, up = sheet.figure.get_size_inches()
    x, y = np.array([right - inches, right]) / across, bottom / up
    tick = 0.045 / up
    sheet.figure.add_artist(Line2D(x, [y, y], color=INK, linewidth=1.2))
    for end in x:
        sheet.figure.add_artist(Line2D([end, end], [y - tick, y + tick], color=INK, linewidth=1.2))
    text = f"{length / 1000:g} km" if length >= 1000 else f"{length:g} m"
    sheet.figure.text(
        float(x[0]) - 0.06 / across, y, text, size=SMALL_PT, color=INK, ha="right", va="center"
    )
