"""The page of a fleet's picture: the map with its legend, times at the right, further panels.

Tested through ``report/fleet/test_fleet_picture``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from matplotlib.axes import Axes

from viaspline.report.canvas import new_figure, tidy
from viaspline.report.sheet import LEFT, TOP, Box, Sheet, draw_heading, draw_scale_bar
from viaspline.report.style import DPI, INK, TEXT_PT

WIDEST, TALLEST, NARROWEST, LOWEST = 7.6, 6.6, 4.4, 1.4  # of the map [inch]
WIDEST_BESIDE: Final = 8.6  # of a map that has room above and below [inch]
COLUMN: Final = 2.55  # for the legend [inch]
BETWEEN: Final = 0.75  # from one column or row of panels to the next [inch]
BOTTOM: Final = 0.6  # below the lowest panel [inch]
SMALL_TALL: Final = 2.7  # of the panels below the map [inch]
TIMES_WIDE: Final = 6.4  # of the panels with times [inch]
ROW_TALL: Final = 0.19  # of a robot's row, at least [inch]
APART_TALL: Final = 1.5  # of the panel of the nearest two [inch]


@dataclass(frozen=True)
class FleetPage:
    """A page.

    Attributes:
        sheet: The map with the column of its legend.
        small: Panels below the map or below the times, from the left.
        rows: Who does what when.
        apart: The nearest two, over the same times.
    """

    sheet: Sheet
    small: tuple[Axes, ...]
    rows: Axes
    apart: Axes


def new_fleet_page(
    view: Box, small: Sequence[float], rows: int, title: str, subtitles: Sequence[str]
) -> FleetPage:
    """A page for a view of the world, as low as it can be.

    Args:
        view: What the map shows [m].
        small: Widths of the panels below the map, or below the times [inch].
        rows: How many robots have a row.
        title: Above it all.
        subtitles: Lines below the title.
    """
    across, up = view[2] - view[0], view[3] - view[1]
    scale = min(WIDEST / across, TALLEST / up)  # inch per metre
    width, height = max(across * scale, NARROWEST), max(up * scale, LOWEST)
    more = SMALL_TALL + BETWEEN if small else 0.0
    times_tall = max(rows, 4) * ROW_TALL + BETWEEN + APART_TALL
    is_below = max(height + more + 0.25, times_tall) < max(height, times_tall + more)
    below, beside = (more + 0.25, 0.0) if is_below else (0.0, more)
    whole = max(height + below, times_tall + beside)
    if not is_below:  # the map may be as tall as what is beside it
        scale = max(scale, min(WIDEST_BESIDE / across, whole / up))
        width, height = max(across * scale, NARROWEST), max(up * scale, LOWEST)
    panels = sum(small) + BETWEEN * max(len(small) - 1, 0)
    times = LEFT + max(width + COLUMN, panels + 0.3 if is_below else 0.0) + BETWEEN
    times_wide = max(TIMES_WIDE, 0.0 if is_below else panels)
    total_w, total_h = times + times_wide + 0.65, BOTTOM + whole + TOP
    figure = new_figure(total_w, total_h)

    def axes(left: float, bottom: float, wide: float, tall: float) -> Axes:
        added = figure.add_axes((left / total_w, bottom / total_h, wide / total_w, tall / total_h))
        tidy(added)
        return added

    bottom = BOTTOM + whole - height
    drawn = axes(LEFT, bottom, width, height)
    middle = (view[0] + view[2]) / 2, (view[1] + view[3]) / 2
    drawn.set_xlim(middle[0] - width / scale / 2, middle[0] + width / scale / 2)
    drawn.set_ylim(middle[1] - height / scale / 2, middle[1] + height / scale / 2)
    drawn.set_xlabel("x, east [m]", labelpad=2)
    drawn.set_ylabel("y, north [m]", labelpad=2)
    left, low = (LEFT, bottom - below) if is_below else (times, BOTTOM)
    lefts = left + np.cumsum([0.0, *(wide + BETWEEN for wide in small)])
    placed = [axes(*at, SMALL_TALL) for at in zip(lefts, [low] * len(small), small, strict=False)]
    apart = axes(times, BOTTOM + beside, times_wide, APART_TALL)
    first = BOTTOM + beside + APART_TALL + BETWEEN
    row_axes = axes(times, first, times_wide, BOTTOM + whole - first)
    side = LEFT + width + 0.25, 0.2 if not is_below else bottom, COLUMN - 0.35, 0.0
    side = (*side[:3], BOTTOM + whole - side[1])
    sheet = Sheet(figure, drawn, (), side, scale * DPI)
    draw_heading(figure, title, subtitles)
    draw_scale_bar(sheet, scale, LEFT + width, total_h - TOP + 0.14)
    return FleetPage(sheet, tuple(placed), row_axes, apart)


def name_panel(axes: Axes, words: str) -> None:
    """The title of a panel."""
    axes.set_title(words, size=TEXT_PT, color=INK, loc="left", pad=5, parse_math=False)
