"""Which cells of a map are blocked, as grids and voxels hold it.

Tested through ``maps/test_grid`` and ``maps/test_voxels``.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viaspline.errors import GeometryError

_REMEDY: Final = "give True where one is blocked, e.g. occupancy > 0.5"


def blocked_cells(cells: ArrayLike) -> NDArray[np.bool_]:
    """The cells as an array that nobody can write to, without a copy if nobody can already.

    Raises:
        GeometryError: They are neither truth values nor zeros and ones, have no regular shape, or
            some of them are masked.
    """
    given = given_cells(cells)
    if given.dtype == np.bool_ and given.flags.c_contiguous and not given.flags.writeable:
        return given
    if given.dtype.kind in "iuf" and given.size:
        _check_truth(given)
    elif given.dtype.kind != "b" and given.size:
        raise GeometryError(f"cells are of the type {given.dtype}; {_REMEDY}")
    copy = np.array(given, dtype=np.bool_, order="C")
    copy.flags.writeable = False
    return copy


def given_cells(cells: ArrayLike) -> NDArray[Any]:
    """What was handed in for cells as an array, not copied if it is one already.

    Raises:
        GeometryError: It has no regular shape, or some cells are masked.
    """
    if np.ma.is_masked(cells):
        raise GeometryError("some cells are masked; say what they are, e.g. cells.filled(True)")
    try:
        return np.asarray(cells)
    except ValueError as error:
        raise GeometryError(f"cells make no array: {error}; {_REMEDY}") from None


def _check_truth(given: NDArray[Any]) -> None:
    """Refuse numbers other than 0 and 1: shares and marks are each map's own."""
    odd = given[(given != 0) & (given != 1)]
    if odd.size:
        raise GeometryError(f"a cell is {odd[0]}, neither 0 nor 1; {_REMEDY}")
