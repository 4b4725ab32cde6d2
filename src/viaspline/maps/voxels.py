"""Voxels as a value: which cubes of space are blocked."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viaspline.errors import GeometryError
from viaspline.handed_in import number_from, numbers_from
from viaspline.maps.blocked_cells import blocked_cells, given_cells
from viaspline.maps.map_reach import check_reach
from viaspline.maps.reading import Reading

MOST_VOXELS_ASIDE = 4096
MOST_VOXELS = 2**31

Corner = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Voxels:
    """Equal cubes in a box whose sides lie along the axes.

    Two are equal when they block the same cubes of the same space, whatever file they came from.

    Attributes:
        blocked: True where a cube is to be kept clear of, shape (nx, ny, nz), read-only.
        cell: Side of a cube [m].
        origin: x, y, z [m] of the outer corner of cube (0, 0, 0).
        source: The file they were read from, as the mission names it; None for some made in memory.
        reading: How they were read; None for some made in memory.

    An array that is read-only already is kept as it is; another one is copied.

    Raises:
        GeometryError: For no cubes, too many of them, or numbers that make no space.

    Example:
        >>> cube = np.zeros((2, 3, 4), bool)
        >>> Voxels(cube, cell=0.5, origin=(1.0, 2.0, 0.0)).extent
        (1.0, 2.0, 0.0, 2.0, 3.5, 2.0)
    """

    blocked: NDArray[np.bool_]
    cell: float
    origin: Corner = (0.0, 0.0, 0.0)
    source: str | None = None
    reading: Reading | None = field(default=None, repr=False)
    digest: bytes = field(init=False, repr=False)

    def __post_init__(self) -> None:
        _check_shape(given_cells(self.blocked))
        cubes = blocked_cells(self.blocked)
        side = number_from("cell", self.cell)
        if not 0.0 < side < math.inf:
            raise GeometryError(f"cell is {self.cell}; give a side above 0 m")
        corner = _corner(self.origin)
        check_reach("a block of voxels", corner, cubes.shape, side)
        numbers = np.array((*cubes.shape, side, *corner), dtype="<f8")
        digest = hashlib.blake2b(np.packbits(cubes).tobytes(), digest_size=16)
        digest.update(numbers.tobytes())
        object.__setattr__(self, "blocked", cubes)
        object.__setattr__(self, "cell", side)
        object.__setattr__(self, "origin", corner)
        object.__setattr__(self, "digest", digest.digest())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Voxels) and self.digest == other.digest

    def __hash__(self) -> int:
        return hash(self.digest)

    def __repr__(self) -> str:
        aside = " x ".join(map(str, self.blocked.shape))
        return f"Voxels({aside} of {self.cell:g} m, {int(self.blocked.sum())} blocked)"

    @property
    def extent(self) -> tuple[float, float, float, float, float, float]:
        """``x_min, y_min, z_min, x_max, y_max, z_max`` [m]."""
        nx, ny, nz = self.blocked.shape
        x, y, z = self.origin
        return x, y, z, x + nx * self.cell, y + ny * self.cell, z + nz * self.cell


def _check_shape(given: NDArray[Any]) -> None:
    """Refuse too many cubes before any is copied."""
    if given.ndim != 3 or not given.size:
        raise GeometryError(f"voxels have shape (nx, ny, nz), not {given.shape}")
    if max(given.shape) > MOST_VOXELS_ASIDE or given.size > MOST_VOXELS:
        aside = " x ".join(map(str, given.shape))
        raise GeometryError(
            f"{aside} voxels are too many; at most {MOST_VOXELS_ASIDE} aside, {MOST_VOXELS} in all"
        )


def _corner(given: Sequence[float]) -> Corner:
    numbers = numbers_from("origin", given)
    if numbers.shape != (3,) or not np.isfinite(numbers).all():
        raise GeometryError(f"the origin of voxels is x, y, z [m], not {given}")
    x, y, z = (numbers + 0.0).tolist()
    return x, y, z
