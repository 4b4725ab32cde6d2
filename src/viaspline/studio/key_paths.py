"""Keys of a mission as people write them, taken apart."""

from __future__ import annotations

import re
from typing import Final, TypeAlias

Path: TypeAlias = tuple[str | int, ...]

_PART: Final = re.compile(r"\[(\d+)\]|([^.\[\]]+)")


def path_of(key: str) -> Path:
    """A key as the way to it; the inverse of ``mission.unplaced_faults.spell``.

    >>> path_of("route.via[2].at"), path_of("")
    (('route', 'via', 2, 'at'), ())
    """
    return tuple(
        int(match[1]) if match[1] is not None else match[2] for match in _PART.finditer(key)
    )
