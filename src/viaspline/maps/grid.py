"""An occupancy grid as a value: which squares of the plane are blocked."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viaspline.errors import GeometryError
from viaspline.handed_in import number_from, numbers_from
from viaspline.maps.blocked_cells import blocked_cells
from viaspline.maps.reading import Reading
from viaspline.presentable.shown_value import ShownValue

MOST_CELLS_ASIDE = 32_000  # kernels count columns in 16 bits
LARGEST_CELL_M = (
    1e4  # side of a square [m]; the largest map is then about as wide as a mission may be
)
Origin = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Grid(ShownValue):
    """Equal squares in rows; row 0 is the lowest, column 0 the leftmost, as in ROS.

    Two grids are equal when they block the same squares of the same plane, whatever file they
    came from.

    Attributes:
        blocked: True where a square is to be kept clear of, shape (height, width), read-only.
        resolution: Side of a square [m].
        origin: x, y [m] of the outer corner of cell (0, 0), and yaw [rad] of the rows.
        source: The file it was read from, as the mission names it; None for one made in memory.
        unknown: True where a square is blocked only because nothing is known of it, shape
            (height, width), read-only; None if there is no such square.
        reading: How it was read; None for one made in memory.

    Arrays that are read-only already are kept as they are; others are copied.

    Raises:
        GeometryError: For an empty grid, one of more than 32,000 cells aside, numbers that make
            no plane, or unknown squares that aren't blocked.

    Example:
        >>> grid = Grid(np.eye(3, dtype=bool), resolution=0.5, origin=(1.0, 2.0, 0.0))
        >>> grid.extent
        (1.0, 2.0, 2.5, 3.5)
        >>> grid.center(row=0, column=2)
        (2.25, 2.25)
    """

    blocked: NDArray[np.bool_]
    resolution: float
    origin: Origin = (0.0, 0.0, 0.0)
    source: str | None = None
    unknown: NDArray[np.bool_] | None = field(default=None, repr=False)
    reading: Reading | None = field(default=None, repr=False)
    digest: bytes = field(init=False, repr=False)

    def __post_init__(self) -> None:
        cells = blocked_cells(self.blocked)
        if cells.ndim != 2 or not cells.size:
            raise GeometryError(f"a grid has shape (height, width), not {cells.shape}")
        if max(cells.shape) > MOST_CELLS_ASIDE:
            raise GeometryError(
                f"a grid of {cells.shape[1]} x {cells.shape[0]} cells is too large; "
                f"at most {MOST_CELLS_ASIDE} aside"
            )
        side = number_from("resolution", self.resolution)
        if not 0.0 < side < math.inf:
            raise GeometryError(f"resolution is {self.resolution}; give a side above 0 m")
        origin = _origin(self.origin)
        unknown = None if self.unknown is None else blocked_cells(self.unknown)
        if unknown is not None and not (unknown.shape == cells.shape and (unknown <= cells).all()):
            raise GeometryError("unknown squares have to be blocked: give unknown <= blocked")
        numbers = np.array((*cells.shape, side, *origin), dtype="<f8")
        digest = hashlib.blake2b(np.packbits(cells).tobytes(), digest_size=16)
        digest.update(numbers.tobytes())
        object.__setattr__(self, "blocked", cells)
        object.__setattr__(self, "unknown", unknown)
        object.__setattr__(self, "resolution", side)
        object.__setattr__(self, "origin", origin)
        object.__setattr__(self, "digest", digest.digest())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Grid) and self.digest == other.digest

    def __hash__(self) -> int:
        return hash(self.digest)

    def __reduce__(self) -> tuple[object, ...]:
        # Arrays forget on the way that they are read-only.
        given = (self.blocked, self.resolution, self.origin, self.source, self.unknown)
        return Grid, (*given, self.reading)

    def __repr__(self) -> str:
        height, width = self.blocked.shape
        return (
            f"Grid({width} x {height} cells of {self.resolution:g} m, origin={self.origin}, "
            f"source={self.source!r})"
        )

    @property
    def width(self) -> int:
        """Cells in a row."""
        return int(self.blocked.shape[1])

    @property
    def height(self) -> int:
        """Rows."""
        return int(self.blocked.shape[0])

    def to_world(self, points: ArrayLike) -> NDArray[np.float64]:
        """From column and row as real numbers (a cell's outer corner is its index) to x, y [m].

        Args:
            points: Shape (n, 2).

        Returns:
            Shape (n, 2).
        """
        x, y, yaw = self.origin
        along = _places(points) * self.resolution
        cos, sin = math.cos(yaw), math.sin(yaw)
        turned = np.column_stack(
            (cos * along[:, 0] - sin * along[:, 1], sin * along[:, 0] + cos * along[:, 1])
        )
        return np.add(turned, (x, y))

    def to_cells(self, points: ArrayLike) -> NDArray[np.float64]:
        """From x, y [m] to column and row as real numbers, the inverse of `to_world`.

        Args:
            points: Shape (n, 2).

        Returns:
            Shape (n, 2).
        """
        x, y, yaw = self.origin
        away = np.subtract(_places(points), (x, y)) / self.resolution
        cos, sin = math.cos(yaw), math.sin(yaw)
        return np.column_stack(
            (cos * away[:, 0] + sin * away[:, 1], cos * away[:, 1] - sin * away[:, 0])
        )

    def center(self, row: int, column: int) -> tuple[float, float]:
        """Middle of a cell [m]."""
        middle = (number_from("column", column) + 0.5, number_from("row", row) + 0.5)
        x, y = self.to_world([middle])[0].tolist()
        return x, y

    @property
    def corners(self) -> NDArray[np.float64]:
        """The grid's outer corners, anticlockwise from cell (0, 0) [m], shape (4, 2)."""
        w, h = self.width, self.height
        return self.to_world([(0, 0), (w, 0), (w, h), (0, h)])

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """x_min, y_min, x_max, y_max of the upright box round the grid [m]."""
        (x0, y0), (x1, y1) = self.corners.min(axis=0), self.corners.max(axis=0)
        return float(x0), float(y0), float(x1), float(y1)


def _places(points: ArrayLike) -> NDArray[np.float64]:
    """Points (n, 2) that were handed in."""
    places = numbers_from("points", points)
    if places.ndim != 2 or places.shape[1] != 2:
        raise GeometryError(f"points have shape {places.shape}; give (n, 2)")
    return places


def _origin(given: Sequence[float]) -> Origin:
    numbers = numbers_from("origin", given)
    if numbers.shape != (3,) or not np.isfinite(numbers).all():
        raise GeometryError(f"a grid's origin is x, y [m] and yaw [rad], not {given}")
    x, y, yaw = (numbers + 0.0).tolist()
    return x, y, yaw
