"""Figures 2, 3 and 5: what a cardinal spline is.

Tested through ``report/test_figures``.
"""

from __future__ import annotations

import numpy as np

from viaspline.curve.cardinal import CardinalSpline
from viaspline.report import style
from viaspline.report.canvas import png, polyline
from viaspline.report.figures.paper import dots, fit, headline, page

VIA_POINTS_M = np.array(
    [(0, 1.0), (1.5, 3.2), (4.0, 2.6), (5.0, 0.4), (7.6, 0.9), (8.6, 3.3), (11, 2.4)]
)
SLACKS = (0.0, 0.5, 1.0, 1.5)
_NO_SHRINK = {"shrinkA": 0, "shrinkB": 0}
SLACK_MEANINGS = (
    "infinite physical tension: the polyline",
    "Catmull-Rom",
    "no physical tension",
    "a compressed spring takes a longer way",
)


def _names(count: int) -> list[str]:
    return [f"$P_{i}$" for i in range(count)]


def fig2() -> bytes:
    """A spline through points, and what its tangents are."""
    figure, ((axes,),) = page(
        "Fig. 2  A spline through points",
        "A cardinal spline runs through every one of its control points. Its tangent at an inner "
        "point (orange) is parallel to the chord between that point's neighbours (dotted); slack s "
        "is its length in units of that chord, here s = 0.5. A span depends on four control points "
        "alone: the thick one, from P2 to P3, on P1 to P4.",
        widths=[7.4], heights=[3.1], titled=False,
    )  # fmt: skip
    spline = CardinalSpline(VIA_POINTS_M, slack=0.5, knots="uniform")
    spans = np.asarray(spline.spans)
    curve = polyline(spans)
    fit(axes, np.vstack([curve, VIA_POINTS_M]))
    axes.plot(*VIA_POINTS_M.T, color=style.MUTED, linewidth=0.7, linestyle=(0, (4, 3)))
    axes.plot(*curve.T, color=style.PATH, linewidth=1.8)
    axes.plot(*polyline(spans[2:3]).T, color=style.PATH, linewidth=4.5, solid_capstyle="butt")
    for k in (2, 4):
        axes.plot(*VIA_POINTS_M[[k - 1, k + 1]].T, color=style.DETOUR, linewidth=1.0, linestyle=":")
        step = 0.25 * (VIA_POINTS_M[k + 1] - VIA_POINTS_M[k - 1])
        axes.annotate(
            "", tuple(VIA_POINTS_M[k] + step), tuple(VIA_POINTS_M[k] - step),
            zorder=9,
            arrowprops={"arrowstyle": "-|>", "color": style.DETOUR, "linewidth": 1.8} | _NO_SHRINK,
        )  # fmt: skip
    dots(axes, VIA_POINTS_M, _names(len(VIA_POINTS_M)))
    return png(figure)


def fig3() -> bytes:
    """Four tensions, in the paper's convention and in that of its Eq. (7)."""
    figure, rows = page(
        "Fig. 3  Four tensions",
        "One parameter with two names. The paper's prose and its Fig. 3 speak of s, which "
        "viaspline calls slack: 0 is the polyline, 0.5 is Catmull-Rom, 1 is no physical tension, "
        "above 1 is a compressed spring. Eq. (7) speaks of t, which viaspline calls tension: "
        "1 is the polyline, 0 is Catmull-Rom, -1 is loose. They are the same by s = (1 - t) / 2.",
        widths=[4.0, 4.0], heights=[2.0, 2.0],
    )  # fmt: skip
    panels = [axes for row in rows for axes in row]
    every = [CardinalSpline(VIA_POINTS_M, slack=slack, knots="uniform") for slack in SLACKS]
    extent = np.vstack([polyline(np.asarray(spline.spans)) for spline in every])
    for axes, spline, slack, meaning in zip(panels, every, SLACKS, SLACK_MEANINGS, strict=True):
        fit(axes, extent, 0.05)
        axes.plot(*VIA_POINTS_M.T, color=style.MUTED, linewidth=0.7, linestyle=(0, (4, 3)))
        axes.plot(*polyline(np.asarray(spline.spans)).T, color=style.PATH, linewidth=2)
        dots(axes, VIA_POINTS_M)
        headline(axes, f"slack s = {slack:g}, tension t = {1 - 2 * slack:g}")
        axes.text(
            0.03, 0.93, meaning, transform=axes.transAxes, size=style.SMALL_PT, color=style.MUTED,
            va="center",
        )  # fmt: skip
        axes.text(
            0.97, 0.93, f"length {spline.length:.2f}", transform=axes.transAxes, ha="right",
            size=style.SMALL_PT, color=style.MUTED, va="center",
        )  # fmt: skip
    return png(figure)


def fig5() -> bytes:
    """The end points, repeated or not."""
    points = VIA_POINTS_M[:6]
    figure, ((without, with_both),) = page(
        "Fig. 5  Why the end points are repeated",
        "A span needs a control point before it and one after it. Six control points alone give "
        "three spans (left): the curve begins at the second point and ends at the last but one. "
        "With the first and the last point repeated there are five spans, and the curve runs "
        "through all six points (right). The spans in the middle are the same.",
        widths=[4.0, 4.0], heights=[2.3],
    )  # fmt: skip
    spans = np.asarray(CardinalSpline(points, slack=0.5, knots="uniform").spans)
    names = _names(len(points))
    doubled = names.copy()
    doubled[0], doubled[-1] = "$P_0$\n(twice)", "$P_5$\n(twice)"
    cases = (
        (without, "as given: 6 control points, 3 spans", spans[1:-1], names),
        (with_both, "ends repeated: 8 control points, 5 spans", spans, doubled),
    )
    for axes, text, curve, labels in cases:
        fit(axes, np.vstack([polyline(spans), points]), 0.17)
        axes.plot(*points.T, color=style.MUTED, linewidth=0.7, linestyle=(0, (4, 3)))
        axes.plot(*polyline(curve).T, color=style.PATH, linewidth=2)
        dots(axes, points, labels, away=15 if labels is doubled else 12)
        headline(axes, text)
        missed = points[[0, -1]]
        if len(curve) < len(spans):
            axes.plot(
                *missed.T, "o", markersize=13, markerfacecolor="none",
                markeredgecolor=style.TIGHTEST, markeredgewidth=1.4,
            )  # fmt: skip
            for point, side in zip(missed, (-1, 1), strict=True):  # beyond its name
                axes.annotate(
                    "not reached", tuple(point), xytext=(0, 24 * side), textcoords="offset points",
                    size=style.SMALL_PT, color=style.TIGHTEST, ha="center", va="center",
                )  # fmt: skip
        else:
            axes.plot(
                *missed.T, "o", markersize=9.5, markerfacecolor="none", markeredgecolor=style.INK,
                markeredgewidth=1.0,
            )  # fmt: skip
    return png(figure)
