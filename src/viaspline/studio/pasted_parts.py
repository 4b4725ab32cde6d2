"""A text that was pasted into the page: the parts of a mission that it holds."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any, Final

from viaspline.errors import MissionError
from viaspline.formats.yaml_document import yaml_document
from viaspline.mission.unplaced_faults import located
from viaspline.studio.document import Document, check_size
from viaspline.studio.refused_error import RefusedError

MAX_PASTED_CHARACTERS: Final = 1_000_000
_LISTS: Final = {"route": ("via",), "world": ("known", "unseen", "fences", "speed_zones")}
_POINTS: Final = ("start", "goal")
_NOTHING: Final = (
    "what was pasted holds no part of a mission: route.via, world.known, world.unseen, "
    "world.fences or world.speed_zones, as they stand in a mission file"
)


def pasted_parts(text: Any) -> Document:
    r"""The points, obstacles and areas of a YAML text, as a mission file holds them.

    Args:
        text: What was pasted: a mission file or parts of one.

    Returns:
        ``route.via`` and the lists of ``world`` that it has; a start and a goal are points like
        the others, without their headings.

    Raises:
        RefusedError: It is no text of YAML, too long, or holds nothing of that kind.

    >>> pasted_parts("route: {via: [[1, 2]], goal: [3, 4]}")
    {'route': {'via': [[1, 2], [3, 4]]}}
    >>> pasted_parts("world: {fences: []}\nrobot: {radius_m: 1}")
    Traceback (most recent call last):
    viaspline.studio.refused_error.RefusedError: what was pasted holds no part of a mission: ...
    """
    if not isinstance(text, str) or len(text) > MAX_PASTED_CHARACTERS:
        raise RefusedError(f"a text of up to {MAX_PASTED_CHARACTERS} characters can be pasted")
    try:
        document = yaml_document(text, "what was pasted")
        if document.faults:
            raise MissionError(located(list(document.faults), document.data, document))
        json.dumps(document.data, allow_nan=False)
    except MissionError as error:
        raise RefusedError(f"{_NOTHING}; {error}") from None
    except ValueError:
        raise RefusedError("what was pasted has a number that is infinite or none") from None
    parts = _parts(document.data)
    if not parts:
        raise RefusedError(_NOTHING)
    check_size(parts)
    return parts


def _parts(data: Mapping[str, Any]) -> dict[str, dict[str, list[Any]]]:
    found: dict[str, dict[str, list[Any]]] = {}
    for section, keys in _LISTS.items():
        given = data.get(section)
        if not isinstance(given, Mapping):
            continue
        for key in keys:
            items = given.get(key)
            items = [item for item in items if item is not None] if isinstance(items, list) else []
            if key == "via":
                start, goal = (_as_via(given.get(end)) for end in _POINTS)
                items = [*start, *items, *goal]
            if items:
                found.setdefault(section, {})[key] = items
    return found


def _as_via(point: Any) -> list[Any]:
    """A start or goal as a via point, which has no heading; empty if there is none."""
    if point is None:
        return []
    if isinstance(point, Mapping):
        return [{key: value for key, value in point.items() if key != "heading_deg"}]
    return [point]
