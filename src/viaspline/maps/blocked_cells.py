"""Which cells of a map are blocked, as grids and voxels hold it.

Tested through ``maps/test_grid``.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


def blocked_cells(cells: ArrayLike) -> NDArray[np.bool_]:
    """The cells as an array that nobody can write to, without a copy if nobody can already."""
    given = np.asarray(cells)
    if given.dtype == np.bool_ and given.flags.c_contiguous and not given.flags.writeable:
        return given
    copy = np.array(given, dtype=np.bool_, order="C")
    copy.flags.writeable = False
    return copy
