"""Who waits when and why: a row for each robot.

Tested through ``report/fleet/test_fleet_picture``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from matplotlib.axes import Axes
from matplotlib.text import Text

from viaspline.fleet.timelines import ActivitySpan, Timeline
from viaspline.report import style
from viaspline.report.canvas import text_width
from viaspline.report.fleet.fleet_page import name_panel

MAX_ROWS = 40  # of the robots that are most delayed
ALL_ROWS = 20  # robots that have a row each, delayed or not
LEAST_ROWS = 8  # of a larger fleet
BAR = 0.72  # of a row
WORTH_SAYING_S = 0.05  # of lateness
STANDS_COLOUR = "#dfe3e8"


def rows_of(timelines: Sequence[Timeline]) -> list[Timeline]:
    """The robots that get a row: all of a small fleet, of a larger one those that are delayed.

    Of a small fleet they are in their order, of a larger one the latest comes first.
    """
    if len(timelines) <= ALL_ROWS:
        return list(timelines)
    late = sorted(range(len(timelines)), key=lambda k: (-timelines[k].late, k))
    count = sum(one.late > WORTH_SAYING_S for one in timelines)
    return [timelines[k] for k in late[: min(max(count, LEAST_ROWS), MAX_ROWS)]]


def _which(shown: Sequence[Timeline], timelines: Sequence[Timeline]) -> str:
    """Which robots have a row, where that isn't all."""
    if len(shown) == len(timelines):
        return ""
    late = sum(one.late > WORTH_SAYING_S for one in timelines)
    if late <= len(shown):
        return f"; {late or 'none'} of {len(timelines)} robots {'are' if late > 1 else 'is'} late"
    return f": the {len(shown)} latest of {len(timelines)} robots"


def draw_waits(
    axes: Axes, shown: Sequence[Timeline], timelines: Sequence[Timeline],
    colours: Mapping[str, str], span: tuple[float, float],
) -> None:  # fmt: skip
    """Draw the chart.

    Args:
        axes: Empty ones.
        shown: The robots that get a row, from the top.
        timelines: Of all robots.
        colours: Of robots by name.
        span: From when to when it goes [s].
    """
    name_panel(axes, f"Who waits when, and for whom{_which(shown, timelines)}")
    axes.set_xlim(span[0], span[1] + 0.09 * (span[1] - span[0]))
    axes.set_ylim(len(shown) - 0.4, -0.6)
    axes.set_yticks(range(len(shown)), [style.short(one.name, 10) for one in shown])
    for label in axes.get_yticklabels():
        label.set_parse_math(False)
        label.set_color(style.INK)
    axes.tick_params(axis="y", length=0)
    axes.grid(axis="x", color=style.OUTSIDE, linewidth=0.6)
    axes.set_axisbelow(True)
    for row, one in enumerate(shown):
        for stretch in one.stretches:
            _draw_stretch(axes, row, stretch, colours[one.name], colours)
        if one.late > WORTH_SAYING_S and one.stretches:
            axes.annotate(
                f"+{one.late:.1f} s", (one.stretches[-1].end, row), (4, 0),
                textcoords="offset points", size=style.SMALL_PT, color=style.INK, va="center",
            )  # fmt: skip


def _draw_stretch(
    axes: Axes, row: int, stretch: ActivitySpan, colour: str, colours: Mapping[str, str]
) -> None:
    lasts = stretch.end - stretch.begin
    if stretch.kind == "drives":
        axes.barh(row, lasts, BAR, stretch.begin, color=colour, linewidth=0)
    elif stretch.kind == "stands":
        axes.barh(
            row, lasts, BAR, stretch.begin, color=STANDS_COLOUR, edgecolor=colour, linewidth=0.6
        )
    else:
        other = colours.get(stretch.other, style.INK)
        axes.barh(
            row, lasts, BAR, stretch.begin, facecolor="white", edgecolor=other, hatch="/////",
            linewidth=0.6,
        )  # fmt: skip
        _name_other(axes, row, stretch, other)


def _name_other(axes: Axes, row: int, stretch: ActivitySpan, colour: str) -> None:
    """The name of whom a robot waits for, where it fits on the bar."""
    words = style.short(stretch.other, 10)
    text = Text(0, 0, words, size=style.SMALL_PT - 0.5, parse_math=False, figure=axes.figure)
    left, right = axes.transData.transform([(stretch.begin, row), (stretch.end, row)])[:, 0]
    if text_width(text) + 3.0 > right - left:
        return
    axes.text(
        (stretch.begin + stretch.end) / 2, row, words, size=style.SMALL_PT - 0.5, color=style.INK,
        ha="center", va="center", parse_math=False,
        bbox={"boxstyle": "square,pad=0.1", "facecolor": "white", "edgecolor": "none"},
    )  # fmt: skip
