"""How far a map may reach, and how small its cells may be: the plane in which missions are.

Tested through ``maps/test_terrain`` and ``maps/test_voxels``.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from viaspline.errors import GeometryError
from viaspline.maps.area import FARTHEST_M

LEAST_CELL_M: Final = 1e-6


def check_reach(what: str, corner: Sequence[float], counts: Sequence[int], cell: float) -> None:
    """Refuse a map that lies where no mission can be.

    Args:
        what: What it is called.
        corner: Its least coordinates [m].
        counts: How many cells it has along each axis.
        cell: From one to the next [m].

    Raises:
        GeometryError: It reaches too far from 0, or its cells are too small to be told apart.
    """
    if cell < LEAST_CELL_M:
        raise GeometryError(f"cells of {what} are {cell:g} m wide; give {LEAST_CELL_M:g} m or more")
    for least, count in zip(corner, counts, strict=True):
        farthest = max(abs(least), abs(least + count * cell))
        if not farthest <= FARTHEST_M:
            raise GeometryError(
                f"{what} reaches {farthest:g} m from 0; put it within {FARTHEST_M:g} m"
            )
