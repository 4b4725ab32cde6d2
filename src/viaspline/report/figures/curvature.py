"""The figure that the paper lacks: curvature along the path, which a cardinal spline lets jump.

Tested through ``report/test_figures``.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from matplotlib.axes import Axes

from viaspline.curve.cardinal import CardinalSpline
from viaspline.kernels.arrays import Floats
from viaspline.report import style
from viaspline.report.canvas import png, polyline
from viaspline.report.figures.paper import dots, fit, headline, page

VIA_POINTS_M = np.array([(0, 0), (20, 26), (50, 22), (62, -2), (92, 2), (106, 28), (134, 18.0)])
COMB_M2 = 160.0  # [m] for a curvature of 1/m
POINTS_PER_SPAN = 90
NO_JUMP_1PM = 1e-6


def curvature_figure() -> bytes:
    """Curves with their combs, and curvature over distance, for both kinds of tangents."""
    figure, rows = page(
        "Curvature along the path",
        "The paper says that curvature is continuous at the via points. For a cardinal spline it "
        "is not: position and heading are continuous, but curvature jumps at every inner via point "
        "(top; the comb stands on the curve, as long as it is bent). The jump is what a robot with "
        'a steering wheel cannot follow without stopping. With tangents="continuous" '
        "(bottom) the same via points and tangents give a curve without jumps, less sharply bent.",
        widths=[4.3, 3.9], heights=[2.25, 2.25], left=0.75,
    )  # fmt: skip
    cases = (
        ("cardinal", CardinalSpline(VIA_POINTS_M, tension=0.0, knots="chordal")),
        (
            "continuous",
            CardinalSpline(VIA_POINTS_M, tension=0.0, knots="chordal", tangents="continuous"),
        ),
    )
    tops = []
    for (left, right), (name, spline) in zip(rows, cases, strict=True):
        _comb(left, spline)
        headline(left, f'tangents="{name}": length {spline.length:.1f} m')
        jumps = np.asarray(spline.curvature_jumps())
        jumps = jumps[np.round(spline.via_parameters[1:-1]).astype(int) - 1]
        tops.append(_plot(right, spline, jumps))
        largest = float(jumps.max())
        words = (
            f"jumps of up to {largest:.3f} 1/m at the via points"
            if largest > NO_JUMP_1PM
            else "no jumps"
        )
        headline(right, words, size=style.TEXT_PT)
        right.set_ylabel("curvature [1/m]", labelpad=1)
    reach = 1.3 * max(tops)
    for _, right in rows:
        right.set_ylim(-reach, reach)
    rows[-1][1].set_xlabel("distance along the path [m]", labelpad=2)
    return png(figure)


def _pieces(spline: CardinalSpline) -> list[Floats]:
    """Parameters from via point to via point, which are seen from inside."""
    joints = spline.via_parameters
    inset = 1e-9 * (joints[-1] - joints[0])
    return [np.linspace(a + inset, b - inset, POINTS_PER_SPAN) for a, b in pairwise(joints)]


def _comb(axes: Axes, spline: CardinalSpline) -> None:
    curve = polyline(np.asarray(spline.spans))
    tips = []
    for u in _pieces(spline):
        points, heading = np.asarray(spline.evaluate(u)), np.asarray(spline.heading(u))
        normal = np.stack([-np.sin(heading), np.cos(heading)], axis=1)
        # on the outside of the bend
        tip = points - COMB_M2 * np.asarray(spline.curvature(u))[:, None] * normal
        tips.append(tip)
        for start, end in zip(points[::6], tip[::6], strict=True):
            axes.plot(*np.array([start, end]).T, color=style.DETOUR, linewidth=0.5, alpha=0.8)
        axes.plot(*tip.T, color=style.DETOUR, linewidth=1.0)
    fit(axes, np.vstack([curve, *tips]), 0.05)
    axes.plot(*curve.T, color=style.PATH, linewidth=2)
    dots(axes, VIA_POINTS_M, [str(number) for number in range(len(VIA_POINTS_M))], away=-9)


def _plot(axes: Axes, spline: CardinalSpline, jumps: Floats) -> float:
    """Curvature over distance with the size of every jump; returns the largest curvature."""
    top = 0.0
    ends: list[tuple[float, float, float]] = []
    for u in _pieces(spline):
        distance, bend = np.asarray(spline.distance(u)), np.asarray(spline.curvature(u))
        axes.plot(distance, bend, color=style.PATH, linewidth=1.6)
        ends.append((float(distance[-1]), float(bend[0]), float(bend[-1])))
        top = max(top, float(np.abs(bend).max()))
    axes.axhline(0, color=style.MUTED, linewidth=0.5)
    axes.set_xlim(0, spline.length)
    for i, (where, _, before) in enumerate(ends[:-1]):
        after = ends[i + 1][1]
        axes.axvline(where, color=style.OBSTACLE, linewidth=0.5, zorder=0)
        axes.plot([where] * 2, [before, after], color=style.TIGHTEST, linewidth=1.6)
        above = max(before, after) > -min(before, after)
        if jumps[i] > NO_JUMP_1PM:
            axes.annotate(
                f"{jumps[i]:.3f}", (where, max(before, after) if above else min(before, after)),
                xytext=(0, 7 if above else -8), textcoords="offset points",
                size=style.SMALL_PT - 0.5, color=style.TIGHTEST, ha="center", va="center",
            )  # fmt: skip
        axes.text(
            where, 0.98, f" {i + 1}", transform=axes.get_xaxis_transform(),
            size=style.SMALL_PT - 0.5, color=style.MUTED, ha="left", va="top",
        )  # fmt: skip
    return top
