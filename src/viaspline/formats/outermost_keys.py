"""The outermost keys of a YAML text, in braces or by lines, however it is indented.

They tell what a text is before it is read; what follows them isn't kept.

Tested through ``formats/test_fleet_yaml``.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError
from ruamel.yaml.events import (
    CollectionEndEvent,
    CollectionStartEvent,
    MappingStartEvent,
    NodeEvent,
    ScalarEvent,
)

PLAN_KEYS: Final = frozenset({"fileType", "mission", "items", "plannedHomePosition"})
"""Those of QGroundControl's files, of which no mission or fleet has any."""


def outermost_keys(text: str) -> Iterator[str]:
    """The keys of the mapping that a text is, as far as it is YAML.

    >>> list(outermost_keys('{"world": {"known": [1, {"a": 2}]}, "fleet": [], "robots": }}'))
    ['world', 'fleet', 'robots']
    >>> list(outermost_keys("- route: 1"))
    []
    """
    depth, parts = 0, 0
    try:
        for event in YAML(typ="safe", pure=True).parse(text):
            if isinstance(event, CollectionEndEvent):
                depth -= 1
            if not isinstance(event, NodeEvent):
                continue
            if depth == 0 and not isinstance(event, MappingStartEvent):
                return
            if depth == 1:
                if parts % 2 == 0 and isinstance(event, ScalarEvent):
                    yield str(event.value)
                parts += 1
            if isinstance(event, CollectionStartEvent):
                depth += 1
    except YAMLError:
        return
