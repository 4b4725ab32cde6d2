"""Occupancy grids on a picture: as many pixels as can be seen, however many squares there are."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import contourpy
import numpy as np
import shapely
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.patches import Rectangle
from numpy.typing import NDArray
from scipy import ndimage

from viaspline.kernels.arrays import Bytes, Floats
from viaspline.maps.grid import Grid
from viaspline.report import style
from viaspline.report.sheet import Box

FREE, UNKNOWN, BLOCKED = 0, 1, 2
DOTS_PER_PIXEL = 2  # dots to a pixel, each way
MAX_DOTS_ASIDE = 2400  # dots aside
UNKNOWN_LABEL = "unknown, kept clear of"
STRIPE_SPACING_DOTS = 12  # from one stripe of unknown ground to the next [dots]


@dataclass(frozen=True)
class MapColours:
    """How blocked squares look: their colour, and that of the edge of what they cover."""

    fill: str = style.OBSTACLE
    edge: str = style.OBSTACLE_EDGE


@dataclass(frozen=True)
class MapGround:
    """An occupancy grid, ready to be drawn.

    Attributes:
        grid: The grid.
        label: What a legend calls its blocked squares.
        tone: How they look.
    """

    grid: Grid
    label: str
    tone: MapColours = MapColours()

    def draw(self, axes: Axes, zorder: float) -> list[Rectangle]:
        """Draw what can be seen of it; returns what belongs in a legend."""
        view = view_of(axes)
        codes = codes_in(self.grid, view, dots_of(axes))
        if not codes.any():
            return []
        axes.imshow(
            _painted(codes, self.tone), origin="lower", extent=(view[0], view[2], view[1], view[3]),
            aspect="auto", interpolation="antialiased", zorder=zorder,
        )  # fmt: skip
        handles = []
        if (codes == BLOCKED).any():
            handles.append(
                Rectangle(
                    (0, 0), 1, 1, facecolor=self.tone.fill, edgecolor=self.tone.edge,
                    linewidth=0.8, label=self.label,
                )
            )  # fmt: skip
        if (codes == UNKNOWN).any():
            handles.append(
                Rectangle(
                    (0, 0), 1, 1, facecolor=style.UNKNOWN, edgecolor=style.UNKNOWN_STRIPE,
                    hatch="////", linewidth=0.0, label=UNKNOWN_LABEL,
                )
            )  # fmt: skip
        return handles


def view_of(axes: Axes) -> Box:
    """What axes show [m]."""
    (x0, x1), (y0, y1) = axes.get_xlim(), axes.get_ylim()
    return float(x0), float(y0), float(x1), float(y1)


def dots_of(axes: Axes) -> tuple[int, int]:
    """How many dots a grid is drawn with: down, across."""
    box = axes.get_window_extent()
    across, up = DOTS_PER_PIXEL * box.width, DOTS_PER_PIXEL * box.height
    few = min(1.0, MAX_DOTS_ASIDE / max(across, up))
    return max(round(up * few), 1), max(round(across * few), 1)


def codes_in(grid: Grid, view: Box, dots: tuple[int, int]) -> Bytes:
    """What is at the middles of equally many dots of a view.

    Where a dot covers several squares it shows the worst of them: blocked, then unknown.

    Args:
        grid: The grid.
        view: x_min, y_min, x_max, y_max [m].
        dots: How many: up, across.

    Returns:
        FREE, UNKNOWN or BLOCKED, the lowest row first, shape ``dots``.

    Example:
        >>> grid = Grid([[0, 1], [0, 0]], resolution=1.0)
        >>> codes_in(grid, (0.0, 0.0, 3.0, 2.0), (2, 3))
        array([[0, 2, 0],
               [0, 0, 0]], dtype=uint8)
    """
    up, across = dots
    x0, y0, x1, y1 = view
    codes = np.zeros(dots, np.uint8)
    cells = grid.to_cells([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])
    left, bottom = np.maximum(np.floor(cells.min(axis=0)), 0).astype(int).tolist()
    limit = grid.width, grid.height
    right, top = np.minimum(np.ceil(cells.max(axis=0)), limit).astype(int).tolist()
    if left >= right or bottom >= top:
        return codes
    dot = min((x1 - x0) / across, (y1 - y0) / up) / grid.resolution  # in squares
    turned = abs(math.sin(2 * grid.origin[2])) > 1e-9
    size = max(math.ceil(dot * (math.sqrt(2) if turned else 1.0) - 1e-9), 1)
    left, bottom = left // size * size, bottom // size * size
    coarse = _coarser(grid, slice(bottom, top), slice(left, right), size)
    # The index of a square is linear in the place of a dot.
    x = x0 + (np.arange(across) + 0.5) * (x1 - x0) / across
    from_x = grid.to_cells(np.column_stack((x, np.full(across, y0))))
    y = y0 + (np.arange(up) + 0.5) * (y1 - y0) / up
    from_y = grid.to_cells(np.column_stack((np.full(up, x0), y))) - cells[0]
    column = _index(from_y[:, :1] + from_x[:, 0], left, size)
    row = _index(from_y[:, 1:] + from_x[:, 1], bottom, size)
    inside = (column >= 0) & (column < coarse.shape[1]) & (row >= 0) & (row < coarse.shape[0])
    codes[inside] = coarse[row[inside], column[inside]]
    return codes


def _index(cells: Floats, first: int, size: int) -> NDArray[np.int32]:
    return np.floor((cells - first) / size).astype(np.int32)


def _coarser(grid: Grid, rows: slice, columns: slice, size: int) -> Bytes:
    """A window of a grid in larger squares, each the worst of those that it is made of."""
    blocked = grid.blocked[rows, columns]
    height, width = blocked.shape
    codes = np.zeros((height + -height % size, width + -width % size), np.uint8)
    window = codes[:height, :width]
    np.multiply(blocked, np.uint8(BLOCKED), out=window)
    if grid.unknown is not None:
        window -= grid.unknown[rows, columns]
    if size == 1:
        return codes
    tall = codes.reshape(-1, size, codes.shape[1]).max(axis=1)
    coarse: Bytes = tall.reshape(len(tall), -1, size).max(axis=2)
    return coarse


def _painted(codes: Bytes, tone: MapColours) -> NDArray[np.float32]:
    """The colours of the dots; free ones are transparent."""
    blocked = codes == BLOCKED
    inner = ndimage.binary_erosion(blocked, np.ones((3, 3), bool), DOTS_PER_PIXEL, border_value=1)
    rows, columns = np.ogrid[: codes.shape[0], : codes.shape[1]]
    striped = (rows + columns) % STRIPE_SPACING_DOTS < DOTS_PER_PIXEL
    picture = np.empty((*codes.shape, 4), np.float32)
    picture[:] = (*to_rgb(tone.fill), 0.0)
    picture[codes == UNKNOWN] = (*to_rgb(style.UNKNOWN), 1.0)
    picture[(codes == UNKNOWN) & striped] = (*to_rgb(style.UNKNOWN_STRIPE), 1.0)
    picture[blocked] = (*to_rgb(tone.edge), 1.0)
    picture[inner] = (*to_rgb(tone.fill), 1.0)
    return picture


def too_near(grid: Grid, view: Box, dots: tuple[int, int], distance: float) -> shapely.Geometry:
    """The ground that is nearer than a distance [m] to what is not free, for the eye.

    Pockets in which a robot could hardly move are left out.

    Args:
        grid: The grid.
        view: What has to be right [m].
        dots: How many dots to measure with: up, across.
        distance: [m].
    """
    metre = (view[2] - view[0]) / dots[1]
    border = min(math.ceil(distance / metre) + 1, MAX_DOTS_ASIDE)  # of what is just out of sight
    reach = border * metre
    wide = view[0] - reach, view[1] - reach, view[2] + reach, view[3] + reach
    codes = codes_in(grid, wide, (dots[0] + 2 * border, dots[1] + 2 * border))
    if not codes.any():
        return shapely.Polygon()
    free = np.asarray(ndimage.distance_transform_edt(codes == FREE)) * metre
    x = wide[0] + (np.arange(codes.shape[1]) + 0.5) * metre
    y = wide[1] + (np.arange(codes.shape[0]) + 0.5) * (wide[3] - wide[1]) / codes.shape[0]
    lines = contourpy.contour_generator(x, y, free, fill_type=contourpy.FillType.OuterOffset)
    points, offsets = lines.filled(-1.0, distance + metre / 2)[:2]
    polygons = []
    for ring, cuts in zip(points, offsets, strict=True):
        if ring is not None and cuts is not None:
            outer, *holes = (ring[first:end] for first, end in pairwise(cuts.tolist()))
            holes = [hole for hole in holes if shapely.Polygon(hole).area > (2 * distance) ** 2]
            polygons.append(shapely.Polygon(outer, holes))
    area = shapely.union_all(shapely.make_valid(np.array(polygons, object)))
    return shapely.simplify(area, metre / 4)


def nearest_point(grid: Grid, place: tuple[float, float]) -> tuple[float, float] | None:
    """The point of the blocked squares that is nearest to a place [m]; None in a free grid."""
    u, v = grid.to_cells([place])[0].tolist()
    reach = 8.0
    while True:
        rows = slice(max(math.floor(v - reach), 0), max(math.ceil(v + reach), 0))
        columns = slice(max(math.floor(u - reach), 0), max(math.ceil(u + reach), 0))
        row, column = np.nonzero(grid.blocked[rows, columns])
        x = np.clip(u, column + columns.start, column + columns.start + 1)
        y = np.clip(v, row + rows.start, row + rows.start + 1)
        away = np.hypot(x - u, y - v)
        if away.size and away.min() <= reach:
            i = int(np.argmin(away))
            at = grid.to_world([(x[i], y[i])])[0].tolist()
            return at[0], at[1]
        if reach > 2 * (abs(u) + abs(v) + grid.width + grid.height):
            return None
        reach *= 4
