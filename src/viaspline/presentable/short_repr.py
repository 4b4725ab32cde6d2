"""A ``repr`` of a line or ten, however much a value holds."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Final

import numpy as np

SHOWN: Final = 4  # items of a list; of a longer one the first two, and how many there are
LONGEST: Final = 700  # letters of one part
WIDE: Final = 100  # letters of a line
MOST_LINES: Final = 10
INDENT: Final = "  "


class ShortText(str):
    """A text whose ``repr`` is itself, for those who put a value's ``repr`` together."""

    __slots__ = ()

    def __repr__(self) -> str:
        return str(self)


def short(value: object) -> ShortText:
    """What a value says, with long lists counted and arrays told by their shape.

    >>> short((1.0, 2.0)), short(tuple(range(900))), short(np.zeros((3, 2)))
    ((1.0, 2.0), (0, 1, … 900 in all), array of shape (3, 2))
    """
    return ShortText(_cut(_text(value)))


def _text(value: object) -> str:
    if isinstance(value, np.ndarray):
        return f"array of shape {value.shape}" if value.size > SHOWN else repr(value.tolist())
    if isinstance(value, Mapping):
        items = [f"{key!r}: {short(item)}" for key, item in list(value.items())[:SHOWN]]
        more = [f"… {len(value)} in all"] if len(value) > SHOWN else []
        return "{" + ", ".join([*items, *more]) + "}"
    if type(value) in (tuple, list):
        assert isinstance(value, tuple | list)
        if len(value) <= SHOWN:
            inside = ", ".join(map(short, value))
        else:
            inside = ", ".join([*map(short, value[:2]), f"… {len(value)} in all"])
        if isinstance(value, list):
            return f"[{inside}]"
        return f"({inside},)" if len(value) == 1 else f"({inside})"
    if isinstance(value, tuple) and hasattr(value, "_fields"):  # named: what kernels see
        said = zip(value._fields, map(short, value), strict=True)
        return one_line(type(value).__name__, said)
    if hasattr(value, "__repr_args__"):  # a value with keys, which alone takes several lines
        return one_line(type(value).__name__, value.__repr_args__())
    return repr(value)


def one_line(name: str, said: Iterable[tuple[str | None, object]]) -> str:
    """A value of a name with what its keys say, however long that is."""
    return f"{name}({', '.join(_items(said))})"


def in_lines(name: str, said: Sequence[tuple[str | None, object]]) -> str:
    """A value of a name in ten lines or fewer, none of them long: it is cut where it says more.

    >>> print(in_lines("Cart", [("name", "r1"), ("radius_m", 0.4)]))
    Cart(name='r1', radius_m=0.4)
    >>> print(in_lines("Cart", [("name", "r" * 60), ("kind", "k" * 60)]).replace("r" * 60, "r…"))
    Cart(
      name='r…',
      kind='kkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkkk',
    )
    """
    whole = one_line(name, said)
    if len(whole) <= WIDE and "\n" not in whole:
        return whole
    lines: list[str] = []
    for item in _items(said):
        item = " ".join(item.split("\n"))
        if len(item) > WIDE - len(INDENT) - 1:
            item = item[: WIDE - len(INDENT) - 2] + "…"
        joined = f"{lines[-1]} {item}," if lines else ""
        if joined and len(joined) <= WIDE:
            lines[-1] = joined
        else:
            lines.append(f"{INDENT}{item},")
    if len(lines) > MOST_LINES - 2:
        lines = [*lines[: MOST_LINES - 3], f"{INDENT}…"]
    return "\n".join([f"{name}(", *lines, ")"])


def _items(said: Iterable[tuple[str | None, object]]) -> list[str]:
    return [repr(value) if key is None else f"{key}={value!r}" for key, value in said]


def _cut(text: str) -> str:
    return text if len(text) <= LONGEST else text[: LONGEST - 1] + "…"
