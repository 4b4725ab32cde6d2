"""Values with arrays in them: equal if they say the same, and with a hash that goes with that.

``==`` of two arrays is an array, so what dataclasses compare by themselves doesn't do.
"""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping
from dataclasses import fields, is_dataclass
from typing import Any, Final

import numpy as np

HASH: Final = "_hash_of_value"


class ComparedByValue:
    """A value that is equal to another one of its class if both say the same.

    It is what its fields say, of a dataclass that is made with ``eq=False``; other classes, and
    those of which not all counts, override ``_said``. Arrays are compared number by number: they
    are equal in shape and in every number, and what is not a number is equal to itself. A copy,
    deep or pickled, is equal to what it was made of.

    >>> from dataclasses import dataclass
    >>> @dataclass(frozen=True, eq=False)
    ... class Row(ComparedByValue):
    ...     numbers: np.ndarray
    >>> Row(np.array([1.0, np.nan])) == Row(np.array([1.0, np.nan]))
    True
    >>> len({Row(np.zeros(2)), Row(-np.zeros(2)), Row(np.ones(2))})
    2
    """

    __slots__ = ()

    def _said(self) -> tuple[object, ...]:
        """All that counts when two are compared."""
        return tuple(getattr(self, one.name) for one in fields(self) if one.compare)  # type: ignore[arg-type]

    def __eq__(self, other: object) -> bool:
        if self is other:
            return True
        if type(self) is not type(other):
            return NotImplemented
        assert isinstance(other, ComparedByValue)
        return is_same(self._said(), other._said())

    def __hash__(self) -> int:
        """Reckoned once: searches keep what they have found by the world that it was found in."""
        known = getattr(self, "__dict__", None)
        if known is None:
            return hash((type(self).__name__, hashed(self._said())))
        if HASH not in known:
            known[HASH] = hash((type(self).__name__, hashed(self._said())))
        found: int = known[HASH]
        return found

    def __getstate__(self) -> Any:
        """Without the hash: another process has another one."""
        state: Any = object.__getstate__(self)
        if isinstance(state, dict):
            return {name: value for name, value in state.items() if name != HASH}
        return state


def is_same(one: object, other: object) -> bool:
    """Whether two things say the same, whatever they are made of.

    >>> is_same({"at": np.array([1, 2])}, {"at": np.array([1.0, 2.0])})
    True
    >>> is_same((np.zeros(2),), (np.zeros((1, 2)),)), is_same((0.0, math.nan), (0.0, math.nan))
    (False, True)
    """
    if one is other:
        return True
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        return _are_same_arrays(one, other)
    if isinstance(one, float) and isinstance(other, float):
        return one == other or (math.isnan(one) and math.isnan(other))
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return one.keys() == other.keys() and all(is_same(one[key], other[key]) for key in one)
    if type(one) is not type(other):
        return bool(one == other)
    if isinstance(one, tuple | list):
        assert isinstance(other, tuple | list)
        both = zip(one, other, strict=False)  # hundreds of obstacles, most of them the same objects
        return len(one) == len(other) and all(a is b or is_same(a, b) for a, b in both)
    if _is_compared_by_fields(one):
        names = [field.name for field in fields(one) if field.compare]  # type: ignore[arg-type]
        return all(is_same(getattr(one, name), getattr(other, name)) for name in names)
    return bool(one == other)


def hashed(value: object) -> Hashable:
    """What stands for a value in a hash: equal for those that ``is_same`` calls equal.

    >>> hashed((1.0, math.nan)) == hashed((1, float("nan")))
    True
    """
    if isinstance(value, np.ndarray):
        return _hashed_array(value)
    if isinstance(value, float):
        return "not a number" if math.isnan(value) else value
    if isinstance(value, Mapping):
        return frozenset((key, hashed(item)) for key, item in value.items())
    if isinstance(value, tuple | list):
        return tuple(map(hashed, value))
    if _is_compared_by_fields(value):
        return tuple(hashed(getattr(value, one.name)) for one in fields(value) if one.compare)  # type: ignore[arg-type]
    try:
        return hash(value)
    except TypeError:  # what can't be told apart by a hash is told apart when it is compared
        return type(value).__name__


def _is_compared_by_fields(value: object) -> bool:
    """Whether ``==`` of a value is what dataclasses make: it fails where there are arrays."""
    if not is_dataclass(value) or isinstance(value, type):
        return False
    made: Any = type(value)
    return bool(made.__dataclass_params__.eq)


def _are_same_arrays(one: object, other: object) -> bool:
    if not (isinstance(one, np.ndarray) and isinstance(other, np.ndarray)):
        return False
    if one.shape != other.shape:
        return False
    has_numbers = one.dtype.kind in "fc" and other.dtype.kind in "fc"
    return bool(np.array_equal(one, other, equal_nan=has_numbers))


def _hashed_array(array: np.ndarray[Any, Any]) -> Hashable:
    shape: tuple[int, ...] = array.shape
    if array.dtype.kind not in "biuf":
        return shape
    numbers = array.astype(np.float64) + 0.0  # no minus nought, and one kind of number
    numbers[np.isnan(numbers)] = np.nan
    return shape, numbers.tobytes()
