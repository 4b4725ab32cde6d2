"""Bounds, rings and places as somebody hands them to a world, checked.

Tested through ``world/test_world_refusals``.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from viaspline.errors import GeometryError
from viaspline.handed_in import all_of, numbers_from
from viaspline.kernels.arrays import Floats

Bounds: TypeAlias = tuple[float, float, float, float]
Ring: TypeAlias = tuple[tuple[float, float], ...]


def checked_bounds(bounds: Sequence[float]) -> Bounds:
    """Bounds as they were handed in.

    Raises:
        GeometryError: They are none.
    """
    numbers = numbers_from("bounds", bounds)
    if numbers.shape != (4,):
        raise GeometryError(
            f"bounds have the shape {numbers.shape}; give x_min, y_min, x_max, y_max"
        )
    x0, y0, x1, y1 = numbers.tolist()
    if not (-math.inf < x0 < x1 < math.inf and -math.inf < y0 < y1 < math.inf):
        raise GeometryError(f"bounds {tuple(bounds)} are empty; give x_min, y_min, x_max, y_max")
    return x0, y0, x1, y1


def checked_rings(name: str, rings: Iterable[Any]) -> tuple[Ring, ...]:
    """Closed rings of corners [m], as they were handed in.

    Raises:
        GeometryError: They aren't.
    """
    found = []
    for i, ring in enumerate(all_of(name, rings, object, "give rings [[x, y], ...]")):
        corners = numbers_from(f"{name}[{i}]", ring)
        if corners.ndim != 2 or corners.shape[1] != 2 or len(corners) < 3:
            raise GeometryError(f"{name}[{i}] isn't a ring; give three corners [x, y] at least")
        if not np.isfinite(corners).all():
            raise GeometryError(f"{name}[{i}] has a corner that is nowhere; give finite numbers")
        found.append(tuple((x, y) for x, y in corners.tolist()))
    return tuple(found)


def flat_places(points: ArrayLike) -> tuple[Floats, tuple[int, ...]]:
    """Places in the plane, one a row (n, 2) [m], and the shape of what is reckoned for each.

    Raises:
        GeometryError: They have another shape than (2,) or (n, 2), or (n, 3), or aren't finite.
    """
    array = numbers_from("points", points)
    if array.ndim == 0 or array.shape[-1] not in (2, 3):
        raise GeometryError(f"points have shape {array.shape}; give (n, 2) or (2,)")
    if not np.isfinite(array).all():
        raise GeometryError("points contain NaN or infinity; give finite numbers")
    flat = np.ascontiguousarray(array[..., :2]).reshape(-1, 2)
    return flat, array.shape[:-1]
