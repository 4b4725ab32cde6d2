"""The picture of a value as a notebook shows it: drawn on a figure of its own, with its legend.

Tested through ``report/notebook/test_plain_axes``.
"""

from __future__ import annotations

from typing import Final

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg

from viaspline.report import style
from viaspline.report.canvas import any_name, new_figure, png, tidy
from viaspline.report.notebook.plain_axes import plot

WIDE, TALL = 6.4, 4.8  # of the axes, at most [inch]
MARGIN: Final = 0.75  # [inch]
COLUMN: Final = 2.7  # for the legend [inch]
PICTURE_DPI: Final = 110


@any_name()
def picture(value: object) -> bytes:
    """The picture as PNG: the same bytes every time.

    Args:
        value: What is shown.
    """
    figure = new_figure(MARGIN + WIDE + COLUMN, TALL + 1.2, PICTURE_DPI)
    across, up = (float(size) for size in figure.get_size_inches())
    axes = figure.add_axes((MARGIN / across, 0.6 / up, WIDE / across, TALL / up))
    tidy(axes)
    plot(value, axes)
    _draw_legend(axes)
    axes.set_title(
        style.short(repr(value).strip("<>"), 100), size=style.TEXT_PT, color=style.INK, loc="left",
        parse_math=False,
    )  # fmt: skip
    return png(figure)


def _draw_legend(axes: Axes) -> None:
    """The legend at the right of axes, where it hides nothing."""
    handles, _ = axes.get_legend_handles_labels()
    if not handles:
        return
    canvas = axes.figure.canvas
    assert isinstance(canvas, FigureCanvasAgg)
    legend = axes.legend(
        handles=handles, loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0,
        frameon=False, fontsize=style.SMALL_PT, markerscale=0.75, labelspacing=0.55,
    )  # fmt: skip
    for text in legend.get_texts():
        text.set_parse_math(False)
        text.set_color(style.INK)
