"""Plain data as lines of YAML that people like to read, and that every reader of YAML understands.

Tested through ``formats/test_mission_yaml`` and ``formats/test_fleet_yaml``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any, Final

_WORD: Final = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
_RESERVED: Final = frozenset({"true", "false", "null", "yes", "no", "on", "off", "y", "n"})


def section(name: str, data: Mapping[str, Any], one_per_line: frozenset[str]) -> Iterator[str]:
    """A mapping, a line for each key.

    Args:
        name: Its own key.
        data: What it holds.
        one_per_line: Keys of lists of which each item has a line of its own.

    >>> list(section("route", {"start": [0, 0], "via": [[1, 2.5]]}, frozenset({"via"})))
    ['route:', '  start: [0, 0]', '  via:', '    - [1, 2.5]']
    """
    yield f"{name}:"
    for key, value in data.items():
        if key in one_per_line and value:
            yield f"  {_text(key)}:"
            yield from (f"    - {flow(item)}" for item in value)
        else:
            yield f"  {_text(key)}: {flow(value)}"


def flow(value: Any) -> str:
    """A value on one line.

    >>> flow({"laps": 3, "at": (0.5, 2.0), "name": "yes", "closed": True})
    '{laps: 3, at: [0.5, 2], name: "yes", closed: true}'
    """
    if isinstance(value, Mapping):
        if value.keys() == {"at"}:
            return flow(value["at"])
        return "{" + ", ".join(f"{_text(key)}: {flow(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(flow, value)) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int | float):
        return _number(value)
    return "null" if value is None else _text(str(value))


def _number(value: float) -> str:
    if value == int(value) and abs(value) < 1e15:
        return str(int(value))
    text = repr(value)
    # Readers of YAML 1.1 take an exponent without a point for a text.
    return text.replace("e", ".0e") if "e" in text and "." not in text else text


def _text(text: str) -> str:
    if _WORD.fullmatch(text) and text.lower() not in _RESERVED:
        return text
    return '"' + "".join(map(_escaped, text)) + '"'


def _escaped(character: str) -> str:
    if character in '"\\':
        return "\\" + character
    return character if character.isprintable() else f"\\U{ord(character):08x}"
