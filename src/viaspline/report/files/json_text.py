"""JSON as people like to read it: the same text every time, rows of numbers on one line."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any

import numpy as np


def plain(value: object) -> Any:
    """Numbers, strings, lists and mappings only; what is not finite becomes None.

    Example:
        >>> plain({"a": np.array([1.5, np.inf]), "b": (1, None)})
        {'a': [1.5, None], 'b': [1, None]}
    """
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if value is None or isinstance(value, bool | int | str):
        return value
    if isinstance(value, float):
        return value + 0.0 if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, set | frozenset):
        return [plain(item) for item in sorted(value, key=str)]
    return str(value)


def dumps(value: object) -> str:
    """JSON text in the order of the keys, ending in a line feed.

    Example:
        >>> print(dumps({"path": {"at": [1.0, 2.0], "of": [[1], [2]]}}), end="")
        {
          "path": {
            "at": [1.0, 2.0],
            "of": [
              [1],
              [2]
            ]
          }
        }
    """
    return _text(plain(value), "") + "\n"


def _text(value: Any, indent: str) -> str:
    if not isinstance(value, list | dict) or _is_row(value):
        return json.dumps(value, ensure_ascii=False, allow_nan=False)
    inner = indent + "  "
    if isinstance(value, dict):
        items = [
            f"{json.dumps(key, ensure_ascii=False)}: {_text(item, inner)}"
            for key, item in value.items()
        ]
        opening, closing = "{}"
    else:
        items = [_text(item, inner) for item in value]
        opening, closing = "[]"
    body = ",\n".join(inner + item for item in items)
    return f"{opening}\n{body}\n{indent}{closing}"


def _is_row(value: Any) -> bool:
    """Whether it goes on one line: empty, or a list of scalars, or of short rows of numbers."""
    if isinstance(value, dict):
        return not value
    return all(not isinstance(item, list | dict) for item in value)
