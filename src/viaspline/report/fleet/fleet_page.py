"""The page of a fleet's picture: the map with its legend, panels below it, times at the right.

Tested through ``report/fleet/test_fleet_picture``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from matplotlib.axes import Axes

from viaspline.report.canvas import new_figure, tidy
from viaspline.report.sheet import LEFT, TOP, Box, Sheet, draw_heading, draw_scale_bar
from viaspline.report.style import DPI, INK, TEXT_PT

WIDEST, TALLEST, NARROWEST, LOWEST = 7.6, 6.6, 4.4, 1.4  # of the map [inch]
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
        small: Panels below the map, from the left.
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
    """A page for a view of the world.

    Args:
        view: What the map shows [m].
        small: Widths of the panels below the map [inch].
        rows: How many robots have a row.
        title: Above it all.
        subtitles: Lines below the title.
    """
    across, up = view[2] - view[0], view[3] - view[1]
    scale = min(WIDEST / across, TALLEST / up)  # inch per metre
    width, height = max(across * scale, NARROWEST), max(up * scale, LOWEST)
    below = SMALL_TALL + BETWEEN + 0.25 if small else 0.0
    whole = max(height + below, max(rows, 2) * ROW_TALL + APART_TALL + BETWEEN)
    total_h = BOTTOM + whole + TOP
    panels = sum(small) + BETWEEN * max(len(small) - 1, 0)
    left_wide = max(width + COLUMN, panels + 0.3)
    times = LEFT + left_wide + BETWEEN
    total_w = times + TIMES_WIDE + 0.65
    figure = new_figure(total_w, total_h)

    def axes(left: float, bottom: float, wide: float, tall: float) -> Axes:
        box = left / total_w, bottom / total_h, wide / total_w, tall / total_h
        added = figure.add_axes(box)
        tidy(added)
        return added

    bottom = BOTTOM + whole - height
    drawn = axes(LEFT, bottom, width, height)
    middle = (view[0] + view[2]) / 2, (view[1] + view[3]) / 2
    drawn.set_xlim(middle[0] - width / scale / 2, middle[0] + width / scale / 2)
    drawn.set_ylim(middle[1] - height / scale / 2, middle[1] + height / scale / 2)
    drawn.set_xlabel("x, east [m]", labelpad=2)
    drawn.set_ylabel("y, north [m]", labelpad=2)
    placed, left = [], LEFT
    for wide in small:
        placed.append(axes(left, bottom - below, wide, SMALL_TALL))
        left += wide + BETWEEN
    apart = axes(times, BOTTOM, TIMES_WIDE, APART_TALL)
    tall = whole - APART_TALL - BETWEEN
    row_axes = axes(times, BOTTOM + APART_TALL + BETWEEN, TIMES_WIDE, tall)
    side = LEFT + width + 0.25, bottom - (0.0 if small else 0.4), COLUMN - 0.35, height
    sheet = Sheet(figure, drawn, (), side, scale * DPI)
    draw_heading(figure, title, subtitles)
    draw_scale_bar(sheet, scale, LEFT + width, total_h - TOP + 0.14)
    return FleetPage(sheet, tuple(placed), row_axes, apart)


def name_panel(axes: Axes, words: str) -> None:
    """The title of a panel."""
    axes.set_title(words, size=TEXT_PT, color=INK, loc="left", pad=5, parse_math=False)
