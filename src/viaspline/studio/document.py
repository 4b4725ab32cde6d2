"""The mission document: what a mission file holds, as plain JSON, changed part by part.

A document is never changed in place: whoever plans an older one in another thread keeps it whole.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Final

from viaspline.mission.space.spatial_parts import has_spatial_keys
from viaspline.studio.refused_error import RefusedError

Step = str | int
Document = Mapping[str, Any]

MAX_NESTING_LEVELS: Final = 16
MAX_DOCUMENT_VALUES: Final = 400_000  # numbers, texts, lists and mappings in all
MAX_LIST_ITEMS: Final = {"known": 5_000, "unseen": 5_000, "fences": 500, "via": 2_000}
MAX_ROBOTS: Final = 1_000  # that the page draws
MAX_CHANGES_PER_MESSAGE: Final = 20_000

EMPTY_DOCUMENT: Final[Document] = {
    "world": {"bounds": [0, 0, 100, 100]},
    "robot": {"radius_m": 0.5, "clearance_m": 0.5, "max_speed_mps": 2},
    "route": {"start": [10, 50], "goal": [90, 50]},
}
"""What a new mission holds."""


def is_fleet(document: Document) -> bool:
    """Whether a document holds a fleet rather than a mission.

    >>> is_fleet({"fleet": []}), is_fleet(EMPTY_DOCUMENT)
    (True, False)
    """
    return "fleet" in document


def is_spatial(document: Document) -> bool:
    """Whether a document holds a mission in space, sound or not.

    >>> is_spatial({"world": {"altitude": {"max_m": 60}}}), is_spatial(EMPTY_DOCUMENT)
    (True, False)
    """
    return has_spatial_keys(document)


def changed(document: Document, changes: Any) -> Document:
    """A document with some of its parts replaced.

    Args:
        document: What there is; it stays as it is.
        changes: ``[path, value]`` sets, ``[path]`` takes out; a path is a list of keys and
            indices, the empty one is the whole document. An index just past the end of a list
            appends.

    Raises:
        RefusedError: When a change makes no sense or the document grows too large.

    >>> changed({"route": {"start": [0, 0]}}, [[["route", "start", 1], 5], [["robot"], {}]])
    {'route': {'start': [0, 5]}, 'robot': {}}
    """
    if not isinstance(changes, list) or len(changes) > MAX_CHANGES_PER_MESSAGE:
        raise RefusedError("changes are a list of [path, value]")
    result: Any = document
    for change in changes:
        path, value = _change(change)
        result = _with(result, path, value)
    if not isinstance(result, Mapping):
        raise RefusedError("a mission is a mapping")
    if changes:
        check_size(result)
    return result


_NO_VALUE: Final = object()


def _change(change: Any) -> tuple[Sequence[Step], Any]:
    if not isinstance(change, list) or len(change) not in (1, 2):
        raise RefusedError("a change is [path, value], or [path] to take something out")
    path = change[0]
    if not isinstance(path, list) or len(path) > MAX_NESTING_LEVELS:
        raise RefusedError(f"a path is a list of at most {MAX_NESTING_LEVELS} keys and indices")
    if not all(
        isinstance(s, str) or (isinstance(s, int) and not isinstance(s, bool)) for s in path
    ):
        raise RefusedError("a path is made of keys and indices")
    return path, change[1] if len(change) == 2 else _NO_VALUE


def _with(node: Any, path: Sequence[Step], value: Any) -> Any:
    if not path:
        return value
    step, rest = path[0], path[1:]
    if isinstance(node, Mapping) and isinstance(step, str):
        return _in_mapping(node, step, rest, value)
    if isinstance(node, list) and isinstance(step, int) and 0 <= step <= len(node):
        return _in_list(node, step, rest, value)
    raise RefusedError(f"there is nothing at {step!r}")


def _in_mapping(node: Mapping[str, Any], key: str, rest: Sequence[Step], value: Any) -> Any:
    if value is _NO_VALUE and not rest:
        return {name: item for name, item in node.items() if name != key}
    if rest and key not in node:
        raise RefusedError(f"there is nothing at {key!r}")
    return {**node, key: _with(node.get(key), rest, value)}


def _in_list(node: list[Any], index: int, rest: Sequence[Step], value: Any) -> list[Any]:
    if index == len(node) and (rest or value is _NO_VALUE):
        raise RefusedError(f"there is nothing at {index}")
    if value is _NO_VALUE and not rest:
        return [*node[:index], *node[index + 1 :]]
    old = node[index] if index < len(node) else None
    return [*node[:index], _with(old, rest, value), *node[index + 1 :]]


def check_size(document: Document) -> None:
    """Refuse what is too large to be laid out.

    Raises:
        RefusedError: It is too large or too deep.
    """
    for part in ("world", "route"):
        section = document.get(part)
        if not isinstance(section, Mapping):
            continue
        for key, most in MAX_LIST_ITEMS.items():
            items = section.get(key)
            if isinstance(items, list) and len(items) > most:
                raise RefusedError(f"{part}.{key} has {len(items)} items; the studio takes {most}")
    members = document.get("fleet")
    if isinstance(members, list) and len(members) > MAX_ROBOTS:
        raise RefusedError(f"the fleet has {len(members)} robots; the studio takes {MAX_ROBOTS}")
    level: list[Any] = [document]
    count = 0
    for _ in range(MAX_NESTING_LEVELS):
        count += len(level)
        if count > MAX_DOCUMENT_VALUES:
            raise RefusedError(f"the mission has more than {MAX_DOCUMENT_VALUES} values")
        inner: list[Any] = []
        for node in level:
            if isinstance(node, Mapping):
                inner.extend(node.values())
            elif isinstance(node, list):
                inner.extend(node)
        if not inner:
            return
        level = inner
    raise RefusedError(f"the mission is nested deeper than {MAX_NESTING_LEVELS} levels")
