"""Terrain as a value: how high the ground is."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viaspline.errors import GeometryError
from viaspline.handed_in import number_from, numbers_from
from viaspline.maps.area import FARTHEST_M
from viaspline.maps.map_reach import check_reach
from viaspline.maps.reading import Reading

MOST_NODES_ASIDE = 32_000
MOST_NODES_IN_ALL = 2**28


@dataclass(frozen=True, eq=False)
class Terrain:
    """Heights at the nodes of a square lattice; between four nodes the ground is bilinear.

    Outside of the lattice, and in every patch that has a node without a height, nothing is known
    of the ground.

    Attributes:
        heights: Of the nodes [m], shape (ny, nx), row 0 the southmost, read-only; NaN where none
            is known. What is masked isn't known either.
        cell: From node to node [m].
        origin: x, y [m] of node (0, 0).
        source: The file it was read from, as the mission names it; None for one made in memory.
        reading: How it was read; None for one made in memory.

    Raises:
        GeometryError: For fewer than two nodes aside, too many, heights that aren't numbers (other
            than NaN), or numbers that make no plane.

    Example:
        >>> slope = Terrain([[0.0, 1.0], [0.0, 1.0]], cell=10.0)
        >>> slope.extent, slope.lowest, slope.highest
        ((0.0, 0.0, 10.0, 10.0), 0.0, 1.0)
    """

    heights: NDArray[np.float64]
    cell: float
    origin: tuple[float, float] = (0.0, 0.0)
    source: str | None = None
    reading: Reading | None = field(default=None, repr=False)
    digest: bytes = field(init=False, repr=False)

    def __post_init__(self) -> None:
        nodes = _nodes(self.heights)
        nodes.flags.writeable = False
        side = number_from("cell", self.cell)
        if not 0.0 < side < math.inf:
            raise GeometryError(f"cell is {self.cell}; give a distance above 0 m")
        corner = _place(self.origin)
        check_reach("a terrain", corner, nodes.shape[::-1], side)
        digest = hashlib.blake2b(nodes.tobytes(), digest_size=16)
        digest.update(np.array((*nodes.shape, side, *corner), dtype="<f8").tobytes())
        object.__setattr__(self, "heights", nodes)
        object.__setattr__(self, "cell", side)
        object.__setattr__(self, "origin", corner)
        object.__setattr__(self, "digest", digest.digest())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Terrain) and self.digest == other.digest

    def __hash__(self) -> int:
        return hash(self.digest)

    def __repr__(self) -> str:
        rows, columns = self.heights.shape
        span = f"{self.lowest:g} to {self.highest:g} m high"
        return f"Terrain({columns} x {rows} nodes, {self.cell:g} m apart, {span})"

    @property
    def extent(self) -> tuple[float, float, float, float]:
        """``x_min, y_min, x_max, y_max`` [m]."""
        ny, nx = self.heights.shape
        x, y = self.origin
        return x, y, x + (nx - 1) * self.cell, y + (ny - 1) * self.cell

    @property
    def lowest(self) -> float:
        """The least height that is known [m]; NaN if none is."""
        return _extreme(self.heights, np.min)

    @property
    def highest(self) -> float:
        """The greatest height that is known [m]; NaN if none is."""
        return _extreme(self.heights, np.max)

    def height_at(self, points: ArrayLike) -> NDArray[np.float64]:
        """Height of the ground at places.

        Args:
            points: x, y [m], shape (..., 2).

        Returns:
            Heights [m], shape (...); NaN where nothing is known of the ground.

        Raises:
            GeometryError: The points have another shape.

        >>> Terrain([[0.0, 1.0], [0.0, 1.0]], cell=10.0).height_at([(5, 5), (11, 5)])
        array([0.5, nan])
        """
        places = numbers_from("points", points)
        if places.ndim == 0 or places.shape[-1] != 2:
            raise GeometryError(f"points have shape {places.shape}; give (..., 2)")
        ny, nx = self.heights.shape
        u = (places[..., 0] - self.origin[0]) / self.cell
        v = (places[..., 1] - self.origin[1]) / self.cell
        inside = (u >= 0) & (v >= 0) & (u <= nx - 1) & (v <= ny - 1)
        i = np.where(inside, np.minimum(u, nx - 2), 0).astype(np.intp)
        j = np.where(inside, np.minimum(v, ny - 2), 0).astype(np.intp)
        a, b = u - i, v - j
        low = (1 - a) * self.heights[j, i] + a * self.heights[j, i + 1]
        high = (1 - a) * self.heights[j + 1, i] + a * self.heights[j + 1, i + 1]
        return np.where(inside, (1 - b) * low + b * high, np.nan)


def _nodes(given: ArrayLike) -> NDArray[np.float64]:
    """Heights as an array of its own; NaN where one is masked."""
    if isinstance(given, np.ndarray):
        if given.dtype.kind not in "biuf":
            raise GeometryError(f"heights are of the type {given.dtype}; give numbers of metres")
        if given.size > MOST_NODES_IN_ALL:
            raise GeometryError(f"{given.size} heights are too many; at most {MOST_NODES_IN_ALL}")
        if np.ma.isMaskedArray(given):
            given = np.ma.filled(given.astype(np.float64), np.nan)
    nodes = np.array(numbers_from("heights", given), dtype=np.float64, order="C")
    if nodes.ndim != 2 or min(nodes.shape) < 2 or max(nodes.shape) > MOST_NODES_ASIDE:
        raise GeometryError(
            f"heights have shape (ny, nx) with 2 to {MOST_NODES_ASIDE} nodes aside, "
            f"not {nodes.shape}"
        )
    if np.isinf(nodes).any():
        raise GeometryError("heights are finite, or NaN where none is known")
    if (np.abs(nodes) > FARTHEST_M).any():
        raise GeometryError(
            f"heights are at most {FARTHEST_M:g} m from 0, or NaN where none is known"
        )
    return nodes


def _extreme(heights: NDArray[np.float64], which: object) -> float:
    known = heights[~np.isnan(heights)]
    return float(which(known)) if known.size else math.nan  # type: ignore[operator]


def _place(given: Sequence[float]) -> tuple[float, float]:
    numbers = numbers_from("origin", given)
    if numbers.shape != (2,) or not np.isfinite(numbers).all():
        raise GeometryError(f"the origin of a terrain is x, y [m], not {given}")
    x, y = (numbers + 0.0).tolist()
    return x, y
