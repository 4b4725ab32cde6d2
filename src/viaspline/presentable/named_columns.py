"""Columns with names, as one array: what pandas and polars take as it is."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats

Table: TypeAlias = NDArray[np.void]
"""A structured array, (n,): ``table["x_m"]`` is a column, ``table[0]`` a row."""


def named_columns(columns: Mapping[str, NDArray[Any]]) -> Table:
    """A table of columns that are equally long.

    Args:
        columns: By their names, each (n,).

    >>> table = named_columns({"time_s": np.array([0.0, 1.0]), "x_m": np.array([2.0, 5.0])})
    >>> table["x_m"], table.dtype.names
    (array([2., 5.]), ('time_s', 'x_m'))
    """
    arrays = {name: np.asarray(values) for name, values in columns.items()}
    rows = len(next(iter(arrays.values())))
    table = np.empty(rows, [(name, values.dtype) for name, values in arrays.items()])
    for name, values in arrays.items():
        table[name] = values
    return table


def stacked_tables(column: str, tables: Mapping[str, Table]) -> Table:
    """Tables of the same columns below each other, with one more before them.

    Args:
        column: The name of the new one.
        tables: By what stands in it, one at least.

    >>> a = named_columns({"x_m": np.array([1.0])})
    >>> stacked_tables("robot", {"r1": a, "r2": a}).tolist()
    [('r1', 1.0), ('r2', 1.0)]
    """
    names = np.repeat(list(tables), [len(table) for table in tables.values()])
    whole = np.concatenate(list(tables.values()))
    assert whole.dtype.names is not None
    return named_columns({column: names, **{name: whole[name] for name in whole.dtype.names}})


def coordinates(points: Floats) -> dict[str, Floats]:
    """The columns of places.

    Args:
        points: Shape (n, d) [m].

    >>> list(coordinates(np.zeros((5, 2))))
    ['x_m', 'y_m']
    """
    return dict(zip(("x_m", "y_m", "z_m"), points.T, strict=False))
