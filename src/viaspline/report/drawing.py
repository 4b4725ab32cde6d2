"""What every picture is made with: figures that touch no global state, curves, shapes, bytes."""

from __future__ import annotations

import io
import warnings
from collections.abc import Sequence

import numpy as np
import shapely
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.path import Path as Outline
from numpy.typing import NDArray

from viaspline.mission.model import Obstacle
from viaspline.report.style import DPI, MUTED, SMALL, TEXT

Floats = NDArray[np.float64]


def new_figure(width: float, height: float, dpi: int = DPI) -> Figure:
    """An empty white figure [inch] with its own canvas."""
    figure = Figure(figsize=(width, height), dpi=dpi, facecolor="white")
    FigureCanvasAgg(figure)
    return figure


def png(figure: Figure) -> bytes:
    """The figure as PNG: no date and no version in it, so the same figure gives the same bytes."""
    buffer = io.BytesIO()
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing")  # of a name in the mission
        figure.savefig(buffer, format="png", dpi="figure", metadata={"Software": None})
    return buffer.getvalue()


def polyline(spans: Floats, per_span: int = 40) -> Floats:
    """Points of a piecewise cubic for drawing, seen from above.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, d).
        per_span: Points for each span.

    Returns:
        Shape (n, 2).
    """
    if not len(spans):
        return np.zeros((0, 2))
    per_span = max(6, min(per_span, 60_000 // len(spans)))
    u = np.linspace(0, 1, per_span, endpoint=False)[:, None]
    weights = np.hstack([(1 - u) ** 3, 3 * u * (1 - u) ** 2, 3 * u**2 * (1 - u), u**3])
    points = np.einsum("uk,mkd->mud", weights, spans[:, :, :2]).reshape(-1, 2)
    return np.vstack([points, spans[-1, 3, :2]])


def shape_of(obstacle: Obstacle, segments: int = 32) -> shapely.Geometry:
    """An obstacle as a polygon; a circle gets ``segments`` sides for each quarter."""
    if obstacle.circle is not None:
        centre = shapely.Point(obstacle.circle.center)
        return centre.buffer(obstacle.circle.radius, quad_segs=segments)
    return shapely.Polygon(obstacle.polygon, obstacle.holes)


def shapes_of(obstacles: Sequence[Obstacle]) -> NDArray[np.object_]:
    """Obstacles as an array of polygons; many circles get fewer sides each."""
    segments = 32 if len(obstacles) < 400 else 8
    shapes = np.empty(len(obstacles), object)
    circles = [i for i, obstacle in enumerate(obstacles) if obstacle.circle is not None]
    if circles:
        discs = [obstacles[i].circle for i in circles]
        centres = shapely.points([disc.center for disc in discs if disc])
        radii = [disc.radius for disc in discs if disc]
        shapes[circles] = shapely.buffer(centres, radii, quad_segs=segments)
    for i, obstacle in enumerate(obstacles):
        if obstacle.circle is None:
            shapes[i] = shape_of(obstacle)
    return shapes


def outline(geometry: shapely.Geometry) -> Outline:
    """A polygon, or a union of polygons, as a matplotlib path with its holes."""
    vertices, codes = [], []
    for part in shapely.get_parts(geometry):
        if shapely.get_type_id(part) != 3 or part.is_empty:
            continue
        for ring in shapely.get_rings(shapely.orient_polygons(part)):
            points = shapely.get_coordinates(ring)
            vertices.append(points)
            codes.append(ring_codes(len(points)))
    if not vertices:
        return Outline(np.zeros((0, 2)))
    return Outline(np.concatenate(vertices), np.concatenate(codes))


def ring_codes(count: int) -> NDArray[np.uint8]:
    """Move, lines, close, for a closed ring of ``count`` points."""
    codes = np.full(count, Outline.LINETO, np.uint8)
    codes[0], codes[-1] = Outline.MOVETO, Outline.CLOSEPOLY
    return codes


def tidy(axes: Axes) -> None:
    """Thin grey frame, small ticks, no offsets in tick labels."""
    axes.tick_params(labelsize=SMALL, color=MUTED, labelcolor=MUTED, width=0.6, length=3)
    axes.ticklabel_format(useOffset=False, style="plain")
    for spine in axes.spines.values():
        spine.set(color=MUTED, linewidth=0.6)
    axes.xaxis.label.set(size=TEXT, color=MUTED)
    axes.yaxis.label.set(size=TEXT, color=MUTED)
