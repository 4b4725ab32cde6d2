"""A robot's footprint as kernels take it.

Tested through ``mission/test_footprint_check``.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viaspline.errors import GeometryError
from viaspline.handed_in import numbers_from


def outline(footprint: ArrayLike) -> NDArray[np.float64]:
    """A footprint's corners as an array of its own, checked (once for each).

    Args:
        footprint: The body in the robot's frame, x forward and y left, (k, 2) [m]: a simple
            polygon, convex or not, with the reference point (0, 0) inside.

    Returns:
        Shape (k, 2).

    Raises:
        GeometryError: When it is no such polygon.

    >>> outline([(-1, -1), (1, -1), (0, 1)]).shape
    (3, 2)
    >>> outline([(1, -1), (3, -1), (3, 1)])
    Traceback (most recent call last):
    ...
    viaspline.errors.GeometryError: the body does not contain its reference point (0, 0), ...
    """
    corners = np.array(numbers_from("footprint", footprint))
    if corners.ndim != 2 or corners.shape[1] != 2:
        raise GeometryError(f"a footprint of shape {corners.shape} isn't an outline; give (k, 2)")
    if not np.isfinite(corners).all():
        raise GeometryError("the footprint contains NaN or infinity; give finite numbers")
    fault = _fault(tuple(map(tuple, corners.tolist())))
    if fault is not None:
        raise GeometryError(fault)
    return corners


@lru_cache(maxsize=64)
def _fault(corners: tuple[tuple[float, float], ...]) -> str | None:
    from viaspline.mission.footprint_check import footprint_fault

    fault = footprint_fault(corners)
    return None if fault is None else f"{fault.problem}; {fault.remedy}"
