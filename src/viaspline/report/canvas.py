"""What every picture is made with: figures that touch no global state, curves, shapes, bytes.

Tested through ``report/test_pictures``.
"""

from __future__ import annotations

import io
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import numpy as np
import shapely
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg, RendererAgg
from matplotlib.figure import Figure, SubFigure
from matplotlib.path import Path as Outline
from matplotlib.text import Text
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats
from viaspline.mission.shapes.obstacle import Obstacle
from viaspline.report.style import DPI, MUTED, SMALL_PT, TEXT_PT

FITTINGS, MOST_OF_FONT = 12, 0.97
"""Steps in which a text is made to fit, and the least of them as a share of its size."""


def new_figure(width: float, height: float, dpi: int = DPI) -> Figure:
    """An empty white figure [inch] with its own canvas."""
    figure = Figure(figsize=(width, height), dpi=dpi, facecolor="white")
    FigureCanvasAgg(figure)
    return figure


@contextmanager
def any_name() -> Iterator[None]:
    """Within the block a name with letters that the font lacks is drawn with boxes, no warning."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing")
        yield


def png(figure: Figure) -> bytes:
    """The figure as PNG: no date and no version in it, so the same figure gives the same bytes."""
    buffer = io.BytesIO()
    figure.savefig(
        buffer, format="png", dpi="figure", metadata={"Software": None},
        pil_kwargs={"compress_level": 4},
    )  # fmt: skip
    return buffer.getvalue()


def renderer_of(figure: Figure | SubFigure) -> RendererAgg:
    """What texts of a figure are measured with, whatever canvas it has."""
    if isinstance(figure.canvas, FigureCanvasAgg):
        renderer: RendererAgg = figure.canvas.get_renderer()  # type: ignore[no-untyped-call]
        return renderer
    return RendererAgg(1, 1, figure.dpi)  # type: ignore[no-untyped-call]


def text_width(text: Text) -> float:
    """How wide a text of a figure is [pixels]."""
    figure = text.get_figure(root=True)
    assert figure is not None
    assert isinstance(figure.canvas, FigureCanvasAgg)
    extent = text.get_window_extent(figure.canvas.get_renderer())  # type: ignore[no-untyped-call]
    return float(extent.width)


def fit(text: Text, right: float) -> None:
    """Make a text smaller until it ends left of a place on its figure [pixels]."""
    figure = text.get_figure(root=True)
    assert figure is not None
    for _ in range(FITTINGS):  # letters are as wide as whole pixels: one step isn't enough
        box = text.get_window_extent(renderer_of(figure))
        if box.x1 <= right or right <= box.x0:
            return
        share = (right - box.x0) / box.width
        text.set_fontsize(text.get_fontsize() * min(share, MOST_OF_FONT))


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
    """An obstacle as a polygon; what is round gets ``segments`` sides for each quarter."""
    ring = obstacle.ring
    return shapely.Polygon() if ring is None else ring.outline(segments)


def shapes_of(obstacles: Sequence[Obstacle]) -> NDArray[np.object_]:
    """Obstacles as an array of polygons; many get fewer sides each."""
    segments = 32 if len(obstacles) < 400 else 8
    shapes = np.empty(len(obstacles), object)
    for i, obstacle in enumerate(obstacles):
        shapes[i] = shape_of(obstacle, segments)
    return shapes


def outline(geometry: shapely.Geometry | NDArray[np.object_]) -> Outline:
    """Polygons, or unions of them, as one matplotlib path with all holes."""
    polygons = shapely.get_parts(np.atleast_1d(np.asarray(geometry, object)))
    polygons = polygons[(shapely.get_type_id(polygons) == 3) & ~shapely.is_empty(polygons)]
    if not polygons.size:
        return Outline(np.zeros((0, 2)))
    rings = shapely.get_rings(shapely.orient_polygons(polygons))
    vertices, ring = shapely.get_coordinates(rings, return_index=True)
    codes = np.full(len(vertices), Outline.LINETO, np.uint8)
    starts = np.searchsorted(ring, np.arange(len(rings)))
    codes[starts] = Outline.MOVETO
    codes[np.append(starts[1:] - 1, len(codes) - 1)] = Outline.CLOSEPOLY
    return Outline(vertices, codes)


def tidy(axes: Axes) -> None:
    """Thin grey frame, small ticks, no offsets in tick labels."""
    axes.tick_params(labelsize=SMALL_PT, color=MUTED, labelcolor=MUTED, width=0.6, length=3)
    axes.ticklabel_format(useOffset=False, style="plain")
    for spine in axes.spines.values():
        spine.set(color=MUTED, linewidth=0.6)
    axes.xaxis.label.set(size=TEXT_PT, color=MUTED)
    axes.yaxis.label.set(size=TEXT_PT, color=MUTED)
