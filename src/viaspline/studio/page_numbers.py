"""Numbers as the page is told them.

Tested through ``studio/test_server``.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from viaspline.kernels.arrays import Floats


def flat(spans: Floats) -> list[float]:
    """Bézier control polygons as x, y, x, y, …, seen from above."""
    values: list[float] = np.ascontiguousarray(spans[:, :, :2]).reshape(-1).tolist()
    return values


def rounded(values: Any, digits: int = 5) -> list[float]:
    """Numbers that are only drawn: to a hundredth of a millimetre."""
    numbers: list[float] = (np.round(np.asarray(values, np.float64), digits) + 0.0).tolist()
    return numbers


def finite(value: float | None) -> float | None:
    """The number, or None where it is infinite."""
    return None if value is None or not math.isfinite(value) else float(value)
