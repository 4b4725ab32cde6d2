"""The cubes of voxels that can be seen, and how high they reach, as few as a page can draw."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Flags, Floats
from viaspline.maps.voxels import Voxels

MAX_CUBES_DRAWN: Final = 40_000


@dataclass(frozen=True, eq=False)
class VoxelCubes:
    """Cubes of voxels with a free side.

    Attributes:
        indices: Of each cube, (n, 3).
        cell: Side of a cube [m]; more than the voxels' own where cubes were taken together.
    """

    indices: NDArray[np.int32]
    cell: float

    @classmethod
    def of(cls, voxels: Voxels, most: int = MAX_CUBES_DRAWN) -> VoxelCubes:
        """The cubes that are seen of voxels.

        Args:
            voxels: The voxels.
            most: Of more than so many, cubes are taken together until there are no more.

        >>> block = VoxelCubes.of(Voxels(np.ones((4, 4, 4), bool), cell=0.5))
        >>> len(block.indices), block.cell
        (56, 0.5)
        >>> block = VoxelCubes.of(Voxels(np.ones((4, 4, 4), bool), cell=0.5), most=20)
        >>> len(block.indices), block.cell
        (8, 1.0)
        """
        blocked: Flags = voxels.blocked
        cell = voxels.cell
        while True:
            found = np.argwhere(_seen(blocked))
            if len(found) <= most or max(blocked.shape) == 1:
                return cls(found.astype(np.int32), cell)
            blocked = _halved(blocked)
            cell *= 2.0


def roof_heights(voxels: Voxels) -> Floats:
    """How high the highest blocked cube of each column reaches [m], (nx, ny); NaN without one.

    >>> cubes = np.zeros((2, 1, 3), bool)
    >>> cubes[0, 0, 1] = True
    >>> roof_heights(Voxels(cubes, cell=2.0)).tolist()
    [[4.0], [nan]]
    """
    blocked = voxels.blocked
    tops = blocked.shape[2] - np.argmax(blocked[:, :, ::-1], axis=2)
    heights = tops * voxels.cell + voxels.origin[2]
    return np.where(blocked.any(axis=2), heights, np.nan)


def _seen(blocked: Flags) -> Flags:
    """The blocked cubes that don't have blocked ones on all six sides."""
    inner = np.zeros_like(blocked)
    if min(blocked.shape) > 2:
        inner[1:-1, 1:-1, 1:-1] = (
            blocked[:-2, 1:-1, 1:-1] & blocked[2:, 1:-1, 1:-1] & blocked[1:-1, :-2, 1:-1]
            & blocked[1:-1, 2:, 1:-1] & blocked[1:-1, 1:-1, :-2] & blocked[1:-1, 1:-1, 2:]
        )  # fmt: skip
    seen: Flags = blocked & ~inner
    return seen


def _halved(blocked: Flags) -> Flags:
    """Blocked wherever one of two cubes aside is."""
    padded = np.pad(blocked, [(0, size % 2) for size in blocked.shape])
    nx, ny, nz = (size // 2 for size in padded.shape)
    pairs = padded.reshape(nx, 2, ny, 2, nz, 2)
    return np.asarray(pairs.any(axis=(1, 3, 5)))
