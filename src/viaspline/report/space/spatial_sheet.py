"""The page of a spatial picture: seen from above and in perspective, the heights below.

Tested through ``report/space/test_spatial_pictures``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from viaspline.report.canvas import new_figure, tidy
from viaspline.report.sheet import Box, draw_heading
from viaspline.report.style import DPI

LEFT, RIGHT, TOP, BOTTOM, GAP = 0.85, 0.35, 0.95, 0.55, 0.75  # margins [inch]
MAP_WIDEST, MAP_TALLEST, MAP_LEAST = 7.0, 6.0, 3.4
ASIDE, LEGEND = 4.6, 1.9
ELEVATION, STRIP, BETWEEN = 2.3, 0.85, 0.14
STRIPS: Final = ("speed [m/s]", "climb [m/s]")
ALONG: Final = "distance along the path [m]"


@dataclass(frozen=True)
class SpatialSheet:
    """A page.

    Attributes:
        figure: The figure.
        map: The plan view, at equal scales; its limits are fixed.
        elevation: The unrolled elevation.
        strips: Speed and climb, over the same distance.
        view: Where the view in perspective goes, as fractions of the figure.
        legend: Left and top of the legend, as fractions.
        pixels_per_metre: The scale of the plan view.
    """

    figure: Figure
    map: Axes
    elevation: Axes
    strips: tuple[Axes, ...]
    view: Box
    legend: tuple[float, float]
    pixels_per_metre: float


def spatial_sheet(
    view: Box, title: str, subtitles: tuple[str, ...], dpi: int = DPI, *,
    strips: tuple[str, ...] = STRIPS, along: str = ALONG,
) -> SpatialSheet:  # fmt: skip
    """A page for a part of the world.

    Args:
        view: x_min, y_min, x_max, y_max of the plan view [m].
        title: The first line.
        subtitles: Those below it.
        dpi: Pixels for each inch.
        strips: What they show below the elevation.
        along: What the elevation and the strips share.
    """
    across, up = view[2] - view[0], view[3] - view[1]
    scale = min(MAP_WIDEST / across, MAP_TALLEST / up)
    width, height = max(across * scale, MAP_LEAST), max(up * scale, MAP_LEAST)
    below = BOTTOM + 2 * (STRIP + BETWEEN) + ELEVATION + GAP
    total_w, total_h = LEFT + width + GAP + ASIDE + RIGHT, below + height + TOP
    figure = new_figure(total_w, total_h, dpi)

    def axes_at(bottom: float, wide: float, tall: float, share: Axes | None) -> Axes:
        box = (LEFT / total_w, bottom / total_h, wide / total_w, tall / total_h)
        axes = figure.add_axes(box, sharex=share)
        tidy(axes)
        return axes

    plan = axes_at(below, width, height, None)
    middle = (view[0] + view[2]) / 2, (view[1] + view[3]) / 2
    plan.set_xlim(middle[0] - width / scale / 2, middle[0] + width / scale / 2)
    plan.set_ylim(middle[1] - height / scale / 2, middle[1] + height / scale / 2)
    plan.set_xlabel("x, east [m]", labelpad=2)
    plan.set_ylabel("y, north [m]", labelpad=2)
    inner = total_w - LEFT - RIGHT
    elevation = axes_at(BOTTOM + 2 * (STRIP + BETWEEN), inner, ELEVATION, None)
    elevation.set_ylabel("height [m]", labelpad=2)
    elevation.tick_params(labelbottom=False)
    drawn = []
    for k, name in enumerate(strips):
        bottom = BOTTOM + (len(strips) - 1 - k) * (STRIP + BETWEEN)
        strip = axes_at(bottom, inner, STRIP, elevation)
        strip.set_ylabel(name, labelpad=2)
        strip.tick_params(labelbottom=k == len(strips) - 1)
        drawn.append(strip)
    drawn[-1].set_xlabel(along, labelpad=2)
    figure.align_ylabels([elevation, *drawn])
    draw_heading(figure, title, subtitles)
    aside = LEFT + width + GAP
    tall = max(height - LEGEND, 1.5)
    box = (aside / total_w, (below + height - tall) / total_h, ASIDE / total_w, tall / total_h)
    legend = (aside / total_w, (below + height - tall - 0.1) / total_h)
    return SpatialSheet(figure, plan, elevation, tuple(drawn), box, legend, scale * dpi)
