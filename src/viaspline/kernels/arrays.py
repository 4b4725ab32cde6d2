"""The arrays that every room passes on, by what they hold: defined here and nowhere else.

Shapes stand in the docstring of whatever takes or gives them.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float64]
"""Lengths, angles, times, and all else that is measured."""

Ints: TypeAlias = NDArray[np.int64]
"""Indices and counts."""

Flags: TypeAlias = NDArray[np.bool_]
"""Yes or no of each."""

Columns: TypeAlias = NDArray[np.int16]
"""Numbers of columns in a row of a grid: two bytes each, for there may be a hundred million."""

Bytes: TypeAlias = NDArray[np.uint8]
"""Cells of a lattice, or levels of a picture."""

Steps: TypeAlias = NDArray[np.int32]
"""Cells, robots and steps of a lattice: four bytes each, for there are tables of all by all."""
