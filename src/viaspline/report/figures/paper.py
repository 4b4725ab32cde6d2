"""Pages for figures: panels at equal scales, a title above, a caption below.

Tested through ``report/test_figures``.
"""

from __future__ import annotations

import textwrap
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viaspline.kernels.arrays import Floats
from viaspline.report import style
from viaspline.report.canvas import new_figure, tidy

SIDE, BETWEEN, ABOVE = 0.45, 0.55, 0.75  # margins [inch]
CAPTION_LINE_IN = 0.185  # of a caption [inch]


def page(
    title: str,
    caption: str,
    *,
    widths: Sequence[float],
    heights: Sequence[float],
    left: float = SIDE,
    titled: bool = True,
) -> tuple[Figure, list[list[Axes]]]:
    """A page with rows and columns of panels.

    Args:
        title: Above everything, bold.
        caption: Below everything, wrapped.
        widths: How wide the columns are [inch].
        heights: How high the rows are [inch].
        left: Margin [inch], wider where there are labels.
        titled: Whether to leave room for a title over each row.

    Returns:
        The figure and the panels by row and column.
    """
    between = BETWEEN if titled else 0.35
    gap = max(left - 0.1, 0.35)
    across = left + sum(widths) + gap * (len(widths) - 1) + 0.3
    lines = textwrap.wrap(caption, int((across - left - 0.2) * 72 / (0.51 * style.TEXT_PT)))
    below = 0.8 + CAPTION_LINE_IN * len(lines)
    up = below + sum(heights) + between * (len(heights) - 1) + ABOVE + (0.15 if titled else 0)
    figure = new_figure(across, up)
    figure.text(
        left / across, 1 - 0.32 / up, title, size=style.TITLE_PT, weight="bold", color=style.INK,
        va="center",
    )  # fmt: skip
    for i, line in enumerate(lines):
        y = (below - 0.6 - i * CAPTION_LINE_IN) / up
        figure.text(left / across, y, line, size=style.TEXT_PT, color=style.INK, va="center")
    rows = []
    top = up - ABOVE - (0.15 if titled else 0)
    for height in heights:
        row = []
        x = left
        for width in widths:
            box = x / across, (top - height) / up, width / across, height / up
            axes = figure.add_axes(box)
            tidy(axes)
            row.append(axes)
            x += width + gap
        rows.append(row)
        top -= height + between
    return figure, rows


def headline(axes: Axes, text: str, *, size: float = style.TEXT_PT) -> None:
    """A title over one panel."""
    axes.set_title(text, size=size, color=style.INK, loc="left", pad=5)


def fit(axes: Axes, points: Floats, margin: float = 0.08) -> None:
    """Limits at equal scales around the points; no ticks."""
    low, high = points.min(0), points.max(0)
    middle, size = (low + high) / 2, np.maximum(high - low, 1e-9)
    box = axes.get_window_extent()
    scale = min(box.width / size[0], box.height / size[1]) / (1 + 2 * margin)
    half = np.array([box.width, box.height]) / scale / 2
    axes.set_xlim(middle[0] - half[0], middle[0] + half[0])
    axes.set_ylim(middle[1] - half[1], middle[1] + half[1])
    axes.set_xticks([])
    axes.set_yticks([])


def dots(axes: Axes, points: Floats, names: Sequence[str] = (), *, away: float = 11.0) -> None:
    """Control points; their names stand off on the outside of the polyline's bends [points]."""
    axes.plot(
        *points.T, "o", markersize=5.5, markerfacecolor="white", markeredgecolor=style.INK,
        markeredgewidth=1.0, zorder=10,
    )  # fmt: skip
    for k, name in enumerate(names):
        before, after = points[max(k - 1, 0)], points[min(k + 1, len(points) - 1)]
        ways = [
            (q - points[k]) / np.linalg.norm(q - points[k])
            for q in (before, after)
            if (q != points[k]).any()
        ]
        outside = -np.sum(ways, axis=0)
        if np.linalg.norm(outside) < 0.2:
            outside = np.array([-ways[0][1], ways[0][0]])
        is_end = k in (0, len(points) - 1)  # within lies the curve
        outside *= (abs(away) if is_end else away) / np.linalg.norm(outside)
        axes.annotate(
            name, tuple(points[k]), xytext=tuple(outside), textcoords="offset points",
            size=style.TEXT_PT, color=style.INK, ha="center", va="center", zorder=11,
        )  # fmt: skip
