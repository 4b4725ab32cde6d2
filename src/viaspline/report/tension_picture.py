"""``tension.png``: what each span's tension does to length, clearance, curvature and time.

Tested through ``test_advice``.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from viaspline.advice import TensionAdvice
from viaspline.kernels.arrays import Floats
from viaspline.report import style
from viaspline.report.canvas import any_name, new_figure, png, tidy

MAX_SPANS_NAMED = 10  # spans in the legend
SPAN_COLOURS = (
    "#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#8c6d31", "#6f7985",
)  # fmt: skip
SPAN_DASHES = ("-", (0, (5, 2)), (0, (1, 1.5)))
WIDTH, HEIGHT, COLUMN = 8.4, 6.6, 2.4  # [inch]


@any_name()
def tension_picture(advice: TensionAdvice, name: str) -> bytes:
    """Four panels over tension, a line for each span, what is suggested marked; as PNG.

    Args:
        advice: What was tried.
        name: The mission's name.
    """
    figure = new_figure(WIDTH + COLUMN, HEIGHT)
    panels = (
        ("length beyond the shortest [m]", _beyond(advice.lengths), None),
        ("proven clearance [m]", advice.clearances, ("asked for", advice.required)),
        ("peak curvature [1/m]", advice.curvatures, _circle(advice)),
        ("time of the drive beyond the fastest [s]", _beyond(advice.durations), None),
    )
    for place, (title, values, limit) in enumerate(panels):
        left = (0.75 + (place % 2) * 4.05) / (WIDTH + COLUMN)
        bottom = (3.42 if place < 2 else 0.55) / HEIGHT
        axes = figure.add_axes((left, bottom, 3.4 / (WIDTH + COLUMN), 2.15 / HEIGHT))
        tidy(axes)
        axes.set_title(title, size=style.TEXT_PT, color=style.INK, loc="left", pad=4)
        _lines(axes, advice, values, limit)
        if place >= 2:
            axes.set_xlabel("tension t  (1: polyline, 0: Catmull-Rom)", labelpad=2)
        if place == 2:
            _above_most(axes, values)
    handles, labels = figure.axes[0].get_legend_handles_labels()
    figure.legend(
        handles[: MAX_SPANS_NAMED + 1], labels[: MAX_SPANS_NAMED + 1], loc="upper left",
        bbox_to_anchor=((WIDTH + 0.05) / (WIDTH + COLUMN), 1 - 0.9 / HEIGHT),
        fontsize=style.SMALL_PT, frameon=False,
    )  # fmt: skip
    across = 0.75 / (WIDTH + COLUMN)
    figure.text(
        across, 1 - 0.28 / HEIGHT, f"{style.short(name, 48)}: what tension does, span by span",
        size=style.TITLE_PT, weight="bold", color=style.INK, va="center", parse_math=False,
    )  # fmt: skip
    figure.text(across, 1 - 0.54 / HEIGHT, _words(advice), size=style.TEXT_PT, color=style.MUTED,
                va="center", parse_math=False)  # fmt: skip
    return png(figure)


def _words(advice: TensionAdvice) -> str:
    low, high = advice.suggested.min(), advice.suggested.max()
    pull = f"t = {low:g}" if low == high else f"t = {low:g} to {high:g}"
    fastest = advice.common[3].min()
    return (
        f"Dots: suggested, {pull}, {advice.duration:.1f} s; the fastest with one tension for all "
        f"takes {fastest:.1f} s. Before any detour."
    )


def _beyond(values: Floats) -> Floats:
    return np.asarray(values - values.min(axis=1, keepdims=True))


def _circle(advice: TensionAdvice) -> tuple[str, float] | None:
    return None if advice.turn_radius is None else ("turning circle", 1.0 / advice.turn_radius)


def _lines(
    axes: Axes, advice: TensionAdvice, values: Floats, limit: tuple[str, float] | None
) -> None:
    """A line for each span with its suggestion, and what is asked for."""
    more = f"and {len(advice.spans) - MAX_SPANS_NAMED} more spans"
    for k, (row, names) in enumerate(zip(values, advice.spans, strict=True)):
        colour = SPAN_COLOURS[k % len(SPAN_COLOURS)]
        label = " → ".join(style.short(part, 14) for part in names)
        axes.plot(
            advice.tensions, np.where(np.isfinite(row), row, np.nan), color=colour, linewidth=1.3,
            linestyle=SPAN_DASHES[k // len(SPAN_COLOURS) % len(SPAN_DASHES)],
            label=label if k < MAX_SPANS_NAMED else more,
        )  # fmt: skip
        chosen = int(np.abs(advice.tensions - advice.suggested[k]).argmin())
        if np.isfinite(row[chosen]):
            axes.plot(
                advice.tensions[chosen], row[chosen], marker="o", markersize=5.5, zorder=5,
                markerfacecolor=colour, markeredgecolor=style.INK, markeredgewidth=0.8,
            )  # fmt: skip
    axes.set_xlim(advice.tensions[0] - 0.04, advice.tensions[-1] + 0.04)
    if not np.isfinite(values).any():
        axes.text(0.5, 0.5, "nothing to keep clear of", transform=axes.transAxes, ha="center",
                  size=style.TEXT_PT, color=style.MUTED)  # fmt: skip
        axes.set_yticks([])
    elif limit is not None:
        axes.axhline(limit[1], color=style.TIGHTEST, linewidth=1.0, linestyle=(0, (4, 2)))
        axes.annotate(
            limit[0], (1.0, limit[1]), xycoords=axes.get_yaxis_transform(), xytext=(-3, 3),
            textcoords="offset points", size=style.SMALL_PT, color=style.TIGHTEST, ha="right",
        )  # fmt: skip


def _above_most(axes: Axes, values: Floats) -> None:
    """Curvature tends to infinity at the polyline: show what lies before."""
    finite = values[np.isfinite(values)]
    if finite.size and finite.min() > 0.0 and finite.max() > 20.0 * np.median(finite):
        axes.set_yscale("log")
