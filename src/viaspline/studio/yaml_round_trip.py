"""A mission document as the text of its file: what wasn't edited stays as it was written.

The old text is parsed with its comments, the new values are put into it, and what is in both is
left alone; so comments, order, spelling and keys that nobody here knows survive.
"""

from __future__ import annotations

import io
import json
from collections.abc import Mapping
from difflib import SequenceMatcher
from typing import Any, Final

from ruamel.yaml import YAML
from ruamel.yaml.comments import CommentedMap, CommentedSeq
from ruamel.yaml.error import YAMLError

from viaspline.studio.document import Document

_BLOCK_MAPPINGS: Final = (("world",), ("robot",), ("robots",), ("route",), ("spline",), ())
_BLOCK_SEQUENCES: Final = (
    ("world", "known"),
    ("world", "unseen"),
    ("world", "fences"),
    ("route", "via"),
    ("fleet",),
)
LINE_WIDTH_CHARACTERS: Final = 4096  # an item stays on its line

Path = tuple[Any, ...]


def text_of(document: Document, old: str | None = None) -> str:
    r"""The text of a mission file.

    Args:
        document: What it is to hold.
        old: What stood there before, to keep its comments.

    >>> print(text_of({"route": {"start": [0, 0], "goal": [9.5, 1]}}), end="")
    route:
      start: [0, 0]
      goal: [9.5, 1]
    >>> print(text_of({"a": [1, 3]}, "a: [1, 2]  # two\nb: 1\n"), end="")
    a: [1, 3] # two
    """
    if old is not None:
        try:
            text = _updated(old, document)
            if plain(_yaml().load(text)) == document:
                return text
        except (YAMLError, ValueError, TypeError, KeyError, RecursionError):
            pass  # a text with anchors or tags that can't be kept: it is written anew
    return _dumped(_fresh(document, ()))


def read(text: str) -> Any:
    """The plain data of a YAML text."""
    return plain(_yaml().load(text))


def plain(value: Any) -> Any:
    """Mappings, lists, texts and numbers without what ruamel remembers of them."""
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, bool) or value is None:
        return value
    for kind in (int, float, str):
        if isinstance(value, kind):
            return kind(value)
    return str(value)


def _yaml() -> YAML:
    yaml = YAML(typ="rt")
    yaml.preserve_quotes = True
    yaml.width = LINE_WIDTH_CHARACTERS
    yaml.indent(mapping=2, sequence=4, offset=2)
    return yaml


def _dumped(tree: Any) -> str:
    stream = io.StringIO()
    _yaml().dump(tree, stream)
    return stream.getvalue()


def _updated(old: str, document: Document) -> str:
    tree = _yaml().load(old)
    if not isinstance(tree, CommentedMap):
        raise ValueError("not a mapping")
    _merge_mapping(tree, document, ())
    return _dumped(tree)


def _merged(node: Any, value: Any, path: Path) -> Any:
    """The node if it already says the value, else the node or a new one that does."""
    if plain(node) == value and type(plain(node)) is type(value):
        return node
    if isinstance(node, CommentedMap) and isinstance(value, Mapping):
        _merge_mapping(node, value, path)
        return node
    if isinstance(node, CommentedSeq) and isinstance(value, list):
        _merge_list(node, value, path)
        return node
    return _fresh(value, path)


def _merge_mapping(node: CommentedMap, value: Mapping[str, Any], path: Path) -> None:
    for key in [key for key in node if key not in value]:
        del node[key]
    for key, item in value.items():
        if key in node:
            merged = _merged(node[key], item, (*path, key))
            if merged is not node[key]:
                node[key] = merged
        else:
            node[key] = _fresh(item, (*path, key))


def _merge_list(node: CommentedSeq, value: list[Any], path: Path) -> None:
    before, after = [_key(plain(item)) for item in node], [_key(item) for item in value]
    steps = SequenceMatcher(None, before, after, autojunk=False).get_opcodes()
    for kind, i1, i2, j1, j2 in reversed(steps):
        if kind == "equal":
            continue
        common = min(i2 - i1, j2 - j1)
        for i in range(i2 - 1, i1 + common - 1, -1):
            del node[i]
        for k in range(common):
            merged = _merged(node[i1 + k], value[j1 + k], (*path, 0))
            if merged is not node[i1 + k]:
                node[i1 + k] = merged
        for k in range(common, j2 - j1):
            node.insert(i1 + k, _fresh(value[j1 + k], (*path, 0)))


def _key(value: Any) -> str:
    return json.dumps(value, sort_keys=True, default=str)


def _fresh(value: Any, path: Path) -> Any:
    """A new node: the sections as blocks, everything else on one line."""
    if isinstance(value, Mapping):
        mapping = CommentedMap({key: _fresh(item, (*path, key)) for key, item in value.items()})
        if path not in _BLOCK_MAPPINGS or not mapping:
            mapping.fa.set_flow_style()
        return mapping
    if isinstance(value, list):
        sequence = CommentedSeq([_fresh(item, (*path, 0)) for item in value])
        if path not in _BLOCK_SEQUENCES or not sequence:
            sequence.fa.set_flow_style()
        return sequence
    return value
