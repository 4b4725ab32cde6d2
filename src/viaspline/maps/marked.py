"""A flat YAML mapping whose values know where they stand.

Tested through ``maps/test_map_server``.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Final, TypeAlias

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, StringMark, YAMLError
from ruamel.yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from viaspline.maps.map_faults import refusal

Mark: TypeAlias = tuple[int, int]

_TRUTHS: Final = {"1": True, "true": True, "yes": True, "on": True} | {
    "0": False, "false": False, "no": False, "off": False,
}  # fmt: skip


@dataclass(frozen=True)
class Marked:
    """A value of a YAML mapping.

    Attributes:
        text: What stands there; None if it is a mapping or a list.
        items: The items of a list.
        at: Line and column, from 1.
    """

    text: str | None
    items: tuple[Marked, ...]
    at: Mark

    @property
    def number(self) -> float | None:
        """The number that it is; None if it is no finite number."""
        try:
            value = float(self.text or "")
        except ValueError:
            return None
        return value if math.isfinite(value) else None

    @property
    def truth(self) -> bool | None:
        """The truth value that it is, in any of YAML's words; None if it is none."""
        return _TRUTHS.get((self.text or "").lower())

    def __str__(self) -> str:
        if self.text is not None:
            return f'"{self.text}"' if self.number is None else self.text
        return f"a list of {len(self.items)}" if self.items else "a mapping or an empty list"


def read_mapping(path: Path, text: str, remedy: str) -> dict[str, Marked]:
    r"""The keys of a YAML mapping and their values.

    Args:
        path: The file, for faults.
        text: What it holds.
        remedy: What it should hold.

    Raises:
        MissionError: It isn't YAML, or isn't a mapping.

    >>> values = read_mapping(Path("a.yaml"), "image: a.pgm\norigin: [1, 2.5, 0]\n", "")
    >>> [item.number for item in values["origin"].items], values["origin"].at
    ([1.0, 2.5, 0.0], (2, 9))
    """
    try:
        root = YAML(typ="safe", pure=True).compose(text)
    except MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        at = (mark.line + 1, mark.column + 1) if isinstance(mark, StringMark) else (1, 1)
        problem = f"is not YAML: {error.problem or error.context}"
        raise refusal(path, problem, remedy, at=at) from None
    except (YAMLError, ValueError, RecursionError) as error:
        raise refusal(path, f"is not YAML: {error}", remedy, at=(1, 1)) from None
    if not isinstance(root, MappingNode):
        problem = "the file is empty" if not text.strip() else "the file isn't a mapping"
        raise refusal(path, problem, remedy, at=(1, 1))
    return {
        str(key.value): _marked(value)
        for key, value in reversed(root.value)  # The first of two stays.
        if isinstance(key, ScalarNode)
    }


def _marked(node: Node) -> Marked:
    at = node.start_mark.line + 1, node.start_mark.column + 1
    if isinstance(node, ScalarNode):
        return Marked(str(node.value), (), at)
    if isinstance(node, SequenceNode):
        items = (item for item in node.value if isinstance(item, ScalarNode))
        return Marked(None, tuple(map(_marked, items)), at)
    return Marked(None, (), at)
