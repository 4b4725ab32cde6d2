"""The column at the right of a map: legend, colour bar, close-up, notes; it hides nothing.

Tested through ``report/test_pictures``.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg, RendererAgg
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.colors import Colormap, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from viaspline.report.canvas import fit, tidy
from viaspline.report.driven_line import DrivenKey
from viaspline.report.sheet import Sheet
from viaspline.report.style import INK, MUTED, SMALL_PT
from viaspline.report.units import nice

PAST_IN = 0.12  # that texts may reach beyond the column, on the page still [inch]


class SideColumn:
    """Fills the column from the top down."""

    def __init__(self, sheet: Sheet) -> None:
        self._sheet = sheet
        self._left, self.bottom, self._width, height = sheet.side
        self._top = self.bottom + height

    @property
    def _right(self) -> float:
        """Where texts have to end [pixels]."""
        return (self._left + self._width + PAST_IN) * self._sheet.figure.dpi

    @property
    def room(self) -> float:
        """Height that is left [inch]."""
        return self._top - self.bottom

    @property
    def map_width(self) -> float:
        """Width of what the map shows [m]."""
        x0, x1 = self._sheet.map.get_xlim()
        return float(x1 - x0)

    def legend(self, handles: Sequence[Artist]) -> None:
        """The legend of the map."""
        figure = self._sheet.figure
        across, up = figure.get_size_inches()
        legend = figure.legend(
            handles=list(handles), loc="upper left", fontsize=SMALL_PT, frameon=False,
            bbox_to_anchor=(self._left / across, self._top / up), borderaxespad=0,
            borderpad=0, handlelength=2.0, labelspacing=0.75, markerscale=0.66,
            handler_map={LineCollection: DrivenKey()},
        )  # fmt: skip
        for text in legend.get_texts():
            text.set_parse_math(False)
            text.set_color(INK)
            fit(text, self._right)
        self._top -= legend.get_window_extent(_renderer(figure)).height / figure.dpi + 0.25

    def colour_bar(self, colours: Colormap, limits: Normalize, title: str) -> None:
        """What the colours of the path mean."""
        box = self._sheet.fraction(self._left, self._top - 0.38, self._width - 0.15, 0.13)
        axes = self._sheet.figure.add_axes(box)
        self._sheet.figure.colorbar(
            ScalarMappable(limits, colours), cax=axes, orientation="horizontal"
        )
        tidy(axes)
        axes.set_title(title, size=SMALL_PT, color=INK, loc="left", pad=3)
        self._top -= 0.85

    def axes(self, height: float, title: str, inset: float = 0.0) -> Axes:
        """Axes without ticks, as wide as the column but for an inset at their left [inch]."""
        head = 0.2 + 0.14 * title.count("\n")
        left, width = self._left + inset, self._width - inset
        box = self._sheet.fraction(left, self._top - head - height, width, height)
        axes = self._sheet.figure.add_axes(box)
        tidy(axes)
        axes.tick_params(left=False, bottom=False, labelleft=False, labelbottom=False)
        text = axes.set_title(title, size=SMALL_PT, color=INK, loc="left", pad=3, parse_math=False)
        fit(text, self._right)
        self._top -= height + head + 0.4
        return axes

    def scale_bar(self, axes: Axes, pixels_per_metre: float) -> None:
        """A bar below the right end of axes of the column."""
        figure = self._sheet.figure
        box = axes.get_position()
        across, up = figure.get_size_inches()
        length = nice(0.4 * figure.dpi / pixels_per_metre)
        y = box.y0 - 0.12 / up
        x = np.array([box.x1 - length * pixels_per_metre / figure.dpi / across, box.x1])
        figure.add_artist(Line2D(x, [y, y], color=INK, linewidth=1.2))
        figure.text(
            float(x[0]) - 0.06 / across, y, f"{length:g} m", size=SMALL_PT, color=INK, ha="right",
            va="center",
        )  # fmt: skip

    def notes(self, title: str, lines: Sequence[str]) -> None:
        """Lines of small text, as many as there is room for."""
        step = 0.155
        fitting = int((self.room - 0.25) / step)
        if not lines or fitting < 2:
            return
        if len(lines) > fitting:
            lines = [*lines[: fitting - 1], f"… {len(lines) - fitting + 1} more"]
        across, up = self._sheet.figure.get_size_inches()
        x = self._left / across
        figure = self._sheet.figure
        figure.text(x, self._top / up, title, size=SMALL_PT, color=INK, weight="bold", va="top")
        for i, line in enumerate(lines):
            y = (self._top - 0.19 - i * step) / up
            text = figure.text(x, y, line, size=7, color=MUTED, va="top", parse_math=False)
            fit(text, self._right)
        self._top -= 0.35 + len(lines) * step


def _renderer(figure: Figure) -> RendererAgg:
    assert isinstance(figure.canvas, FigureCanvasAgg)
    renderer: RendererAgg = figure.canvas.get_renderer()  # type: ignore[no-untyped-call]
    return renderer
