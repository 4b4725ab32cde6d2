"""Values of many fields that say what they are in ten lines or fewer.

Tested through ``presentable/test_short_repr``.
"""

from __future__ import annotations

from dataclasses import fields, is_dataclass
from typing import TypeVar

from viaspline.presentable.short_repr import ShortText, in_lines, short

Kind = TypeVar("Kind", bound=type)


def told_in_lines(kind: Kind) -> Kind:
    """Make the values of a dataclass or a named tuple say what they are in a line or ten.

    Arrays are told by their shape, long lists are counted, and what is too long is cut.

    >>> from dataclasses import dataclass
    >>> @told_in_lines
    ... @dataclass(frozen=True)
    ... class Row:
    ...     numbers: tuple[int, ...]
    >>> Row(tuple(range(900)))
    Row(numbers=(0, 1, … 900 in all))
    """

    def told(self: object) -> str:
        if is_dataclass(self):
            names = [field.name for field in fields(self) if field.repr]
        else:
            names = list(getattr(self, "_fields", ()))
        said: list[tuple[str | None, ShortText]] = [
            (name, short(getattr(self, name))) for name in names
        ]
        return in_lines(type(self).__name__, said)

    kind.__repr__ = told  # type: ignore[method-assign, assignment]
    return kind
