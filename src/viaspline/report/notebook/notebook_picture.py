"""The picture of a value as a notebook shows it: drawn on a figure of its own, with its legend.

Tested through ``report/notebook/test_plain_axes``.
"""

from __future__ import annotations

import io
from typing import Final

from matplotlib.collections import LineCollection

from viaspline.presentable.upper_doors import opened_for
from viaspline.report import style
from viaspline.report.canvas import any_name, new_figure, tidy
from viaspline.report.driven_line import DrivenKey

WIDE, TALL = 6.4, 4.8  # of the axes, at most [inch]
MARGIN: Final = 0.75  # [inch]
COLUMN: Final = 2.7  # for the legend [inch]
AROUND: Final = 0.12  # what is left of the figure [inch]
PICTURE_DPI: Final = 110
LONGEST_TITLE: Final = 110  # letters


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
    handles = opened_for("marks", value)(value, axes)
    if handles:
        legend = axes.legend(
            handles=handles, loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0.0,
            frameon=False, fontsize=style.SMALL_PT, markerscale=0.66, labelspacing=0.75,
            handler_map={LineCollection: DrivenKey()},
        )  # fmt: skip
        for text in legend.get_texts():
            text.set_parse_math(False)
            text.set_color(style.INK)
    title = repr(value).strip("<>")
    if len(title) > LONGEST_TITLE:
        title = type(value).__name__
    axes.set_title(title, size=style.TEXT_PT, color=style.INK, loc="left", parse_math=False)
    buffer = io.BytesIO()
    figure.savefig(
        buffer, format="png", dpi="figure", bbox_inches="tight", pad_inches=AROUND,
        metadata={"Software": None},
    )  # fmt: skip
    return buffer.getvalue()
