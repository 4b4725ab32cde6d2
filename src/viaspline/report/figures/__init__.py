"""The figures of the paper, made again from the package's own curves and plans.

``FIGURES`` holds, for each file, its caption and the function that draws it.
"""

from __future__ import annotations

from collections.abc import Callable

from viaspline.report.figures.curvature import curvature_figure
from viaspline.report.figures.splines import fig2, fig3, fig5
from viaspline.report.figures.worlds import fig6, fig7, fig8

FIGURES: dict[str, tuple[str, Callable[[], bytes]]] = {
    "fig2.png": ("a spline through points", fig2),
    "fig3.png": ("four tensions, by both of their names", fig3),
    "fig5.png": ("why the end points are repeated", fig5),
    "fig6.png": ("a zigzag survey", fig6),
    "fig7.png": ("a group of obstacles, passed by the shorter side", fig7),
    "fig8.png": ("via points and obstacles together", fig8),
    "curvature.png": (
        "where curvature jumps, and the tangents that make it continuous",
        curvature_figure,
    ),
}
