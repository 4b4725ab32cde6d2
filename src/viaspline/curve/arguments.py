"""Arguments on their way to the kernels: validated, converted, writable.

Tested through ``curve/test_piecewise``.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from viaspline.errors import GeometryError
from viaspline.handed_in import numbers_in
from viaspline.kernels.arrays import Floats


def working_copy(values: ArrayLike) -> Floats:
    """A fresh array in row order.

    Raises:
        GeometryError: When the values are not numbers in a regular shape.
    """
    return np.array(numbers_in(values), order="C")


def call(values: ArrayLike) -> tuple[Floats, tuple[int, ...]]:
    """A flat array that the kernels take as it is, and the shape to give the answer.

    Read-only arrays are copied: to the kernels they are another type, compiled again.
    """
    array = numbers_in(values)
    flags = array.flags
    if not (flags.c_contiguous and flags.writeable and flags.aligned):
        array = array.copy(order="C")
    return array.reshape(-1), array.shape


def frozen(array: Floats) -> Floats:
    """A read-only view."""
    view = array.view()
    view.flags.writeable = False
    return view


def outside(name: str, value: float, domain: tuple[float, float]) -> GeometryError:
    """The error for a value that is not in a domain, or not a number."""
    return GeometryError(f"{name} = {float(value)} is outside [{domain[0]}, {domain[1]}]")


def as_point(point: ArrayLike, dimension: int) -> Floats:
    """A point of d finite numbers.

    Raises:
        GeometryError: When it is something else.
    """
    array = working_copy(point)
    if array.shape != (dimension,) or not np.isfinite(array).all():
        raise GeometryError(f"a point of {dimension} finite numbers is needed, not {point!r}")
    return array
