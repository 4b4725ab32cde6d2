"""``tension.png``: what tension does to the drive, and each span's to the spline.

Tested through ``test_advice``.
"""

from __future__ import annotations

from textwrap import fill

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viaspline.advice import TensionAdvice
from viaspline.compared_tensions import TensionTrial
from viaspline.kernels.arrays import Floats, Ints
from viaspline.report import style
from viaspline.report.advice_words import advice_words, tension_words
from viaspline.report.canvas import any_name, new_figure, png, tidy
from viaspline.span_tensions import SpanTensions

WORDS_WIDTH = 110  # characters in a line below the title
MAX_SPANS_NAMED = 10  # spans in the legend
SPAN_COLOURS = (
    "#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#8c6d31", "#6f7985",
)  # fmt: skip
SPAN_DASHES = ("-", (0, (5, 2)), (0, (1, 1.5)))
FAINT_ALPHA = 0.25
WIDTH, HEIGHT, COLUMN = 8.4, 7.05, 2.5  # [inch]
LOG_FROM = 20.0  # times the median from which a panel has a logarithmic scale
FLAT_SHARE = 1e-6  # of what is shown, below which a panel's range is opened up


@any_name()
def tension_picture(advice: TensionAdvice, name: str) -> bytes:
    """The drive with one tension for all spans above, each span's own below; as PNG.

    Args:
        advice: What was tried.
        name: The mission's name.
    """
    figure = new_figure(WIDTH + COLUMN, HEIGHT)
    across = 0.75 / (WIDTH + COLUMN)
    what = "what tension does" if advice.matters else "there is no tension to choose"
    figure.text(
        across, 1 - 0.28 / HEIGHT, f"{style.short(name, 48)}: {what}",
        size=style.TITLE_PT, weight="bold", color=style.INK, va="center", parse_math=False,
    )  # fmt: skip
    words = fill(advice_words(advice), WORDS_WIDTH)
    figure.text(across, 1 - 0.48 / HEIGHT, words, size=style.TEXT_PT,
                color=style.MUTED, va="top", parse_math=False)  # fmt: skip
    _drives(figure, advice)
    if advice.effects is not None:
        _spans(figure, advice, advice.effects)
    return png(figure)


def _panel(figure: Figure, column: int, row: int, title: str) -> Axes:
    left = (0.75 + column * 4.05) / (WIDTH + COLUMN)
    bottom = (3.72, 0.6)[row] / HEIGHT
    axes = figure.add_axes((left, bottom, 3.4 / (WIDTH + COLUMN), 2.2 / HEIGHT))
    tidy(axes)
    axes.set_title(title, size=style.TEXT_PT, color=style.INK, loc="left", pad=4)
    axes.set_xlabel("tension t  (1: polyline, 0: Catmull-Rom)", labelpad=2)
    return axes


def _drives(figure: Figure, advice: TensionAdvice) -> None:
    """The time and the peak curvature of the whole plans."""
    trials = [trial for trial in advice.common if trial.plan is not None]
    for column, title in enumerate((
        "whole plan, all spans alike: drive [s]", "whole plan, all spans alike: peak [1/m]",
    )):  # fmt: skip
        axes = _panel(figure, column, 0, title)
        values = [trial.cost[column] for trial in trials]
        axes.plot(
            [trial.level for trial in trials], values, color=style.PATH, linewidth=1.3,
            marker="o", markersize=3.5, label="one tension for all spans",
        )  # fmt: skip
        _mark(axes, advice.stands, column, "as it stands", style.DETOUR, "s")
        _mark(
            axes, advice.chosen if advice.matters else None, column, "suggested", style.START, "o"
        )
        costs = [trial.cost[column] for trial in advice.trials if trial.plan is not None]
        _open_up(axes, np.array(costs))
        _circle(axes, advice, column)
    _legend(figure, figure.axes[0], 1.0)


def _mark(
    axes: Axes, trial: TensionTrial | None, column: int, label: str, colour: str, marker: str
) -> None:
    """A tension for all spans as a dot, any other one as a line across."""
    if trial is None or trial.plan is None:
        return
    value = trial.cost[column]
    words = f"{label}: {tension_words(trial.tension)}"
    if not np.isnan(trial.level):
        axes.plot(
            trial.level, value, marker=marker, markersize=8, linestyle="none", zorder=5,
            markerfacecolor="none", markeredgecolor=colour, markeredgewidth=1.8, label=words,
        )  # fmt: skip
    else:
        dashes = (0, (4, 2)) if marker == "o" else (0, (1, 1.5))
        axes.axhline(value, color=colour, linewidth=1.5, linestyle=dashes, label=words)


def _circle(axes: Axes, advice: TensionAdvice, column: int) -> None:
    """The turning circle, where peaks come near to it."""
    radius = advice.plan.mission.robot.turn_radius
    if column == 0 or radius is None or not 1.0 / radius <= axes.get_ylim()[1]:
        return
    axes.axhline(1.0 / radius, color=style.TIGHTEST, linewidth=1.0, linestyle=(0, (4, 2)))
    axes.annotate(
        "turning circle", (0.0, 1.0 / radius), xycoords=axes.get_yaxis_transform(),
        xytext=(3, 3), textcoords="offset points", size=style.SMALL_PT, color=style.TIGHTEST,
    )  # fmt: skip


def _open_up(axes: Axes, values: Floats) -> None:
    """A range for what is nowhere different, lest rounding be drawn."""
    if np.ptp(values) <= FLAT_SHARE * max(1.0, float(values.max())):
        middle = float(values.mean())
        axes.set_ylim(0.0, 2.0 * middle if middle > FLAT_SHARE else 1.0)
        words = "the same, whatever the tension"
        axes.text(0.5, 0.75, words, transform=axes.transAxes, ha="center",
                  size=style.TEXT_PT, color=style.MUTED)  # fmt: skip


def _spans(figure: Figure, advice: TensionAdvice, effects: SpanTensions) -> None:
    """What each span's tension costs and how sharp it makes the spline."""
    taken = effects.nearest(np.nan_to_num(advice.by_span))
    for column, (title, values) in enumerate(
        (
            ("the spline, span by span: beyond the fastest [s]", effects.lost(taken)),
            ("the spline, span by span: peak [1/m]", effects.curvatures),
        )
    ):
        axes = _panel(figure, column, 1, title)
        _lines(axes, advice, effects, values, taken)
        finite = values[np.isfinite(values)]
        _open_up(axes, np.ptp(values, axis=1) if column == 0 else finite)
        if column == 1 and finite.min() > 0.0 and finite.max() > LOG_FROM * np.median(finite):
            axes.set_yscale("log")
        _circle(axes, advice, column)
    _legend(figure, figure.axes[2], 4.12)


def _lines(
    axes: Axes, advice: TensionAdvice, effects: SpanTensions, values: Floats, taken: Ints
) -> None:
    """A line for each span, faint where it can't be driven."""
    more = f"and {len(advice.spans) - MAX_SPANS_NAMED} more spans"
    for k, (row, names) in enumerate(zip(values, advice.spans, strict=True)):
        colour = SPAN_COLOURS[k % len(SPAN_COLOURS)]
        dashes = SPAN_DASHES[k // len(SPAN_COLOURS) % len(SPAN_DASHES)]
        label = " → ".join(style.short(part, 14) for part in names)
        axes.plot(
            effects.tensions, row, color=colour, linewidth=1.0, linestyle=dashes, alpha=FAINT_ALPHA
        )
        axes.plot(
            effects.tensions, np.where(effects.allowed[k], row, np.nan), color=colour,
            linewidth=1.4, linestyle=dashes, label=label if k < MAX_SPANS_NAMED else more,
        )  # fmt: skip
        if advice.matters and advice.suggested is not None and effects.allowed[k, taken[k]]:
            axes.plot(
                effects.tensions[taken[k]], row[taken[k]], marker="o", markersize=5.5, zorder=5,
                markerfacecolor=colour, markeredgecolor=style.INK, markeredgewidth=0.8,
            )  # fmt: skip


def _legend(figure: Figure, axes: Axes, top: float) -> None:
    handles, labels = axes.get_legend_handles_labels()
    title = "faint: too near or too sharp" if top > HEIGHT / 2 else None
    figure.legend(
        handles[: MAX_SPANS_NAMED + 1], labels[: MAX_SPANS_NAMED + 1], loc="upper left",
        bbox_to_anchor=((WIDTH + 0.05) / (WIDTH + COLUMN), 1 - top / HEIGHT),
        fontsize=style.SMALL_PT, title=title,
        title_fontsize=style.SMALL_PT, alignment="left", frameon=False,
    )  # fmt: skip
