"""A ``repr`` of a line or ten, however much a value holds."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import numpy as np

SHOWN: Final = 4  # items of a list; of a longer one the first two, and how many there are
LONGEST: Final = 700  # letters of one part


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
    return repr(value)


def _cut(text: str) -> str:
    return text if len(text) <= LONGEST else text[: LONGEST - 1] + "…"
