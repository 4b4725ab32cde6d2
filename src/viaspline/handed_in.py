"""What a person hands in from Python: refused by name where it is something else.

Tested through ``test_junk_arguments``.
"""

from __future__ import annotations

import math
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import NDArray

from viaspline.errors import GeometryError

LONGEST_PERIOD_S = 10.0  # from step to step; loops of robots have 5 to 100 in a second
LONGEST_S = 1e6  # between two steps of a drive, beyond which a time is a mistake


def check_kind(name: str, value: object, kind: Any, example: str) -> None:
    """Refuse an argument of another class.

    Args:
        name: The argument's.
        value: What was handed in.
        kind: What it has to be.
        example: How to come by one.

    Raises:
        GeometryError: It is something else.

    >>> check_kind("limits", 5, dict, "give Limits(max_speed=2, max_accel=1)")
    Traceback (most recent call last):
    viaspline.errors.GeometryError: limits is of the class int, not dict; give Limits(max_speed=...
    """
    if not isinstance(value, kind):
        kinds = kind if isinstance(kind, tuple) else (kind,)
        names = " or ".join(getattr(one, "__name__", str(one)) for one in kinds)
        problem = f"{name} is of the class {type(value).__name__}, not {names}"
        raise GeometryError(f"{problem}; {example}")


def number_from(name: str, value: object) -> float:
    """A number that was handed in.

    Raises:
        GeometryError: It is none, or too large for one.

    >>> number_from("clearance", 2)
    2.0
    """
    if isinstance(value, str | bytes):
        raise GeometryError(f"{name} is {value!r:.40}; give a number")
    try:
        return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        raise GeometryError(f"{name} is {value!r:.40}; give a number") from None


def finite_from(name: str, value: object) -> float:
    """A finite number that was handed in.

    Raises:
        GeometryError: It is none, or not finite.

    >>> finite_from("stamp", 2)
    2.0
    """
    number = number_from(name, value)
    if not math.isfinite(number):
        raise GeometryError(f"{name} is {number}; give a finite number")
    return number


def room_from(clearance: object, radius: object) -> tuple[float, float]:
    """What is to be kept free, and the radius of a body, as they were handed in [m].

    With a clearance below 0 a path through a wall would keep what is asked.

    Raises:
        GeometryError: One is no finite number, or below 0.

    >>> room_from(1, 0.5)
    (1.0, 0.5)
    """
    found = number_from("clearance", clearance), number_from("radius", radius)
    if not all_finite(*found):
        raise GeometryError(f"clearance {found[0]} and radius {found[1]} have to be finite")
    for name, value in zip(("clearance", "radius"), found, strict=True):
        if value < 0.0:
            raise GeometryError(f"{name} is {value}; give 0 or more")
    return found


def all_finite(*values: object) -> bool:
    """Whether all that was handed in are finite numbers.

    >>> all_finite(2, 0.5), all_finite(2, float("nan")), all_finite("2")
    (True, False, False)
    """
    try:
        return all(math.isfinite(value) for value in values)  # type: ignore[arg-type]
    except (TypeError, ValueError, OverflowError):
        return False


def time_from(name: str, value: object) -> float:
    """A length of time that was handed in [s].

    Raises:
        GeometryError: It is no number above 0, or longer than a robot's drive can be.

    >>> time_from("step", 0)
    Traceback (most recent call last):
    viaspline.errors.GeometryError: step is 0; give a time above 0 s, up to 1e+06 s
    """
    seconds = number_from(name, value)
    if not 0.0 < seconds <= LONGEST_S:
        raise GeometryError(
            f"{name} is {value!r:.40}; give a time above 0 s, up to {LONGEST_S:g} s"
        )
    return seconds


def period_from(name: str, value: object) -> float:
    """The time between two steps of a control loop that was handed in [s].

    Raises:
        GeometryError: It is none, or as long as a rate or milliseconds are that were meant.

    >>> period_from("period", 20)
    Traceback (most recent call last):
    viaspline.errors.GeometryError: period is 20 s; give seconds from step to step, below 10: 0.0...
    """
    seconds = time_from(name, value)
    if seconds >= LONGEST_PERIOD_S:
        remedy = f"give seconds from step to step, below {LONGEST_PERIOD_S:g}: 0.05 for 20 Hz"
        raise GeometryError(f"{name} is {seconds:g} s; {remedy}")
    return seconds


def seed_from(name: str, value: object) -> int:
    """The seed of a generator of random numbers that was handed in.

    Raises:
        GeometryError: It is no whole number from 0 on.

    >>> seed_from("seed", 3)
    3
    """
    if not isinstance(value, int | np.integer) or value < 0:
        raise GeometryError(f"{name} is {value!r:.40}; give a whole number from 0 on")
    return int(value)


def check_callable(name: str, value: object, example: str) -> None:
    """Refuse an argument that can't be called.

    Raises:
        GeometryError: It can't be.
    """
    if not callable(value):
        raise GeometryError(f"{name} is {value!r:.40}, which can't be called; {example}")


def numbers_in(values: object) -> NDArray[np.float64]:
    """Numbers that were handed in as an array; the same one if they are one already.

    Nothing and text are none, though numpy makes nan of nothing and reads text.

    Raises:
        GeometryError: It holds something else, or has no regular shape.
    """
    try:
        found = np.asarray(values)
        if found.dtype.kind not in "fiub":
            for value in found.flat:
                if not isinstance(value, Real):
                    told = value.item() if isinstance(value, np.generic) else value
                    raise TypeError(f"found {told!r:.40}")
        return found.astype(np.float64, copy=False)
    except (TypeError, ValueError, OverflowError) as error:
        raise GeometryError(f"expected numbers: {error}") from None


def numbers_from(name: str, values: object) -> NDArray[np.float64]:
    """An argument of numbers; see ``numbers_in``.

    Raises:
        GeometryError: It holds something else, or has no regular shape.
    """
    try:
        return numbers_in(values)
    except GeometryError as error:
        raise GeometryError(f"{name}: {error}") from None


def all_of(
    name: str, values: object, kind: type | tuple[type, ...], example: str
) -> tuple[Any, ...]:
    """The items of a list that was handed in.

    Raises:
        GeometryError: It is no list, or an item is of another class.
    """
    try:
        items: tuple[Any, ...] = tuple(values)  # type: ignore[arg-type]
    except TypeError:
        raise GeometryError(f"{name} is {values!r:.40}, not a list; {example}") from None
    for i, item in enumerate(items):
        check_kind(f"{name}[{i}]", item, kind, example)
    return items


def check_answers(name: str, value: object, asked: str, example: str) -> None:
    """Refuse an argument that doesn't answer what it is asked.

    Args:
        name: The argument's.
        value: What was handed in.
        asked: An attribute that it needs.
        example: How to come by one.

    Raises:
        GeometryError: It has no such attribute.
    """
    if not hasattr(value, asked):
        problem = f"{name} is of the class {type(value).__name__}, which has no {asked}"
        raise GeometryError(f"{problem}; {example}")
