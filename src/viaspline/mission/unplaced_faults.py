"""Faults before they have a place in a file: a path into the mission's data, and what is wrong.

Tested through ``mission/test_model``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any, Final, NamedTuple, Protocol, TypeAlias

from viaspline.errors import Change, Fault

Path: TypeAlias = tuple[str | int, ...]
"""Keys and indices from the mission down, e.g. ``("route", "via", 2, "at")``."""

MAX_REPORTED_FAULTS: Final = 5
"""How many faults of one list of rows are told."""


class Mark(NamedTuple):
    """A place in a file, both from 1."""

    line: int
    column: int


class UnplacedFault(NamedTuple):
    """Something wrong.

    Attributes:
        path: Where in the data.
        problem: What is wrong.
        remedy: What would be right.
        at_key: Whether the key itself is wrong, rather than its value.
        mark: Where in the file, if ``path`` doesn't tell it.
        changes: The remedy for programs, see `Fault`.
    """

    path: Path
    problem: str
    remedy: str
    at_key: bool = False
    mark: Mark | None = None
    changes: tuple[Change, ...] = ()


class Origin(Protocol):
    """Where data came from: turns paths into places."""

    @property
    def source(self) -> str:
        """The file."""
        ...

    @property
    def faults(self) -> tuple[UnplacedFault, ...]:
        """What was found wrong before there was data."""
        ...

    def mark(self, path: Path, *, at_key: bool) -> Mark:
        """The place of the value (or its key) at ``path``, or of the nearest thing around it."""
        ...


def spell(path: Path) -> str:
    """A path as people write it.

    >>> spell(("route", "via", 2, "at"))
    'route.via[2].at'
    """
    text = ""
    for part in path:
        if isinstance(part, int):
            text += f"[{part}]"
        else:
            text += f".{part}" if text else part
    return text


def located(faults: list[UnplacedFault], data: Any, origin: Origin | None) -> list[Fault]:
    """The faults with their places, in the order of the file (or of the data if there is none)."""
    if origin is None:
        ordered = sorted(faults, key=lambda fault: _rank(data, fault.path))
        return [
            Fault(spell(fault.path), fault.problem, fault.remedy, changes=fault.changes)
            for fault in ordered
        ]
    placed = [
        (fault.mark or origin.mark(fault.path, at_key=fault.at_key), fault) for fault in faults
    ]
    placed.sort(key=lambda pair: pair[0])
    return [
        Fault(
            spell(fault.path),
            fault.problem,
            fault.remedy,
            origin.source,
            mark.line,
            mark.column,
            fault.changes,
        )
        for mark, fault in placed
    ]


def of_file(path: Path, asking: str, fault: Fault) -> UnplacedFault:
    """A fault of a file as a fault of the key that asks for it.

    Args:
        path: What that key stands in.
        asking: The key.
        fault: What is wrong with the file, or with what else is asked of it.
    """
    if fault.line is None and fault.key in ("unknown", "resolution_m", "cell_m"):
        return UnplacedFault((*path, fault.key), fault.problem, fault.remedy, at_key=True)
    place = fault.source if fault.line is None else f"{fault.source}:{fault.line}:{fault.column}"
    key = f"{fault.key}: " if fault.key else ""
    return UnplacedFault(
        (*path, asking), f"{place}: {key}{fault.problem}", fault.remedy, at_key=True
    )


def children(value: Any) -> Mapping[Any, Any] | None:
    """The keys and values of a mapping or a model; None for anything else."""
    if isinstance(value, Mapping):
        return value
    from pydantic import BaseModel  # a mission file without faults is read without it

    return dict(value) if isinstance(value, BaseModel) else None


def list_items(value: Any) -> Iterator[tuple[int, Any]]:
    """The items of a list with their indices; nothing if it is none."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, list | tuple):
        yield from enumerate(value)


def _rank(data: Any, path: Path) -> tuple[int, ...]:
    """The position of a path in a walk through the data; absent keys come last."""
    rank: list[int] = []
    for part in path:
        mapping = children(data)
        if mapping is not None:
            keys = list(mapping)
            rank.append(keys.index(part) if part in keys else len(keys))
            data = mapping.get(part)
        elif isinstance(part, int):
            rank.append(part)
            is_sound = isinstance(data, list | tuple) and part < len(data)
            data = data[part] if is_sound else None
    return tuple(rank)


LIMIT_DECIMALS: Final = 12
"""Decimals of a limit, of which none is left out."""


def number(value: float, decimals: int = 3) -> str:
    """A number for people: no more decimals than asked for, no needless zeros.

    Numbers of numpy, too, which ``repr`` would write with their type's name.

    >>> number(12.0), number(0.58049), number(-0.0001)
    ('12', '0.58', '0')
    """
    rounded = round(float(value), decimals) + 0.0
    if rounded == 0:
        return "0"
    return repr(int(rounded)) if rounded == int(rounded) else repr(rounded)


def is_number(text: str) -> bool:
    """Whether a text is a number.

    >>> is_number("30.5"), is_number("30.5 6")
    (True, False)
    """
    try:
        float(text)
    except ValueError:
        return False
    return True


def describe(value: Any) -> str:
    """What was found, in a few words.

    >>> describe(True), describe("0.5"), describe([1, 2]), describe(None)
    ('true', 'the text "0.5"', 'a list of 2', 'nothing')
    """
    if value is None:
        return "nothing"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float) and not math.isfinite(value):
        return "NaN" if math.isnan(value) else "infinity"
    if isinstance(value, int | float):
        text = f"{value:g}" if abs(value) < 1e300 else "a huge number"
        return text
    if isinstance(value, str):
        shown = value if len(value) <= 40 else value[:37] + "..."
        return 'the text "' + shown.encode("unicode_escape").decode("ascii", "replace") + '"'
    if isinstance(value, Mapping):
        return "a mapping"
    if isinstance(value, list | tuple):
        return f"a list of {len(value)}" if value else "an empty list"
    return f"a value of type {type(value).__name__}"
