"""A YAML document as plain data that remembers where everything stood.

The document is composed to nodes, not loaded: nodes have marks, and what loading would hide
(duplicate keys, tags, dates) can be told to the user.

Tested through ``formats/test_mission_yaml``.
"""

from __future__ import annotations

from pathlib import Path as FilePath
from typing import Any, Final

from ruamel.yaml import YAML
from ruamel.yaml.error import MarkedYAMLError, StringMark, YAMLError
from ruamel.yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode
from ruamel.yaml.reader import ReaderError

from viaspline.bounded_file import MISSION_FILE, read_text
from viaspline.errors import Fault, MissionError
from viaspline.formats.number_lists import (
    MAX_PARTS,
    NumberListScanner,
    Starts,
    TooManyPartsError,
    count_of,
    is_number_list,
    mark_within,
    numbers_of,
    starts_of,
)
from viaspline.mission.unplaced_faults import Mark, Path, UnplacedFault, describe

_TAG: Final = "tag:yaml.org,2002:"
_PLAIN: Final = (_TAG + "map", _TAG + "seq", _TAG + "str")
"""The tags of mappings and lists; of one of plain numbers the last, as it is taken whole."""
_TOO_MANY: Final = f"from here on there are more than the {MAX_PARTS} parts that are read"


class Document:
    """One YAML document.

    Attributes:
        source: The file.
        data: Mappings, lists, texts, numbers, truth values and None.
        faults: Duplicate keys, tags and the like.
    """

    def __init__(self, source: str, root: Node) -> None:
        self.source = source
        self._root = root
        self._keys: dict[tuple[int, str], Node] = {}
        self._faults: list[UnplacedFault] = []
        self._made: dict[int, Any] = {}
        self._starts: dict[int, Starts] = {}
        self._counts: dict[int, int] = {}
        self._count = 0
        self.data = self._value(root, ())

    @property
    def faults(self) -> tuple[UnplacedFault, ...]:
        """What was found wrong before there was data."""
        return tuple(self._faults)

    def mark(self, path: Path, *, at_key: bool) -> Mark:
        """The place of the value (or its key) at ``path``, or of the nearest thing around it."""
        node, key = self._root, None
        for i, part in enumerate(path):
            if is_number_list(node):
                if id(node) not in self._starts:
                    self._starts[id(node)] = starts_of(node)
                return mark_within(node, self._starts[id(node)], path[i:])
            if isinstance(part, int) and isinstance(node, SequenceNode) and part < len(node.value):
                node, key = node.value[part], None
            elif isinstance(part, str) and isinstance(node, MappingNode):
                key = self._keys.get((id(node), part))
                if key is None:
                    break  # It is missing: the mapping that lacks it is the place.
                node = self._made_node(node, part)
        return _mark(key if at_key and key is not None else node)

    def _made_node(self, node: MappingNode, name: str) -> Node:
        key = self._keys[id(node), name]
        found: Node = next(value for other, value in node.value if other is key)
        return found

    def _value(self, node: Node, path: Path) -> Any:
        before = self._count
        if id(node) in self._made:
            self._count += self._counts.get(id(node), 0)
            if self._count > MAX_PARTS:
                problem = f"with its aliases the file has more than {MAX_PARTS} parts"
                raise _fault(self.source, _mark(node), problem, MISSION_FILE.smaller)
            return self._made[id(node)]
        self._count += 1
        if is_number_list(node):
            self._check_tag(node, path)
            self._count += count_of(node.value)
            self._made[id(node)] = numbers_of(node)
            self._counts[id(node)] = self._count - before
            return self._made[id(node)]
        if isinstance(node, ScalarNode):
            return self._scalar(node, path)
        self._check_tag(node, path)
        # Until it is done, so that an alias inside of what it stands for ends here.
        self._made[id(node)] = None
        value: Any = None
        if isinstance(node, SequenceNode):
            value = [self._value(item, (*path, i)) for i, item in enumerate(node.value)]
        elif isinstance(node, MappingNode):
            value = self._mapping(node, path)
        self._made[id(node)] = value
        self._counts[id(node)] = self._count - before
        return value

    def _check_tag(self, node: Node, path: Path) -> None:
        if str(node.tag) not in _PLAIN:
            self._faults.append(_tagged(node, path))

    def _mapping(self, node: MappingNode, path: Path) -> dict[Any, Any]:
        data: dict[Any, Any] = {}
        for key_node, value_node in node.value:
            key = self._key(key_node, path)
            if key is None:
                continue
            first = self._keys.get((id(node), key))
            if first is None:
                self._keys[id(node), key] = key_node
                data[key] = self._value(value_node, (*path, key))
            else:
                problem = f"duplicate key; it stands in line {_mark(first).line} already"
                remedy = "keep one of the two"
                self._faults.append(
                    UnplacedFault((*path, key), problem, remedy, mark=_mark(key_node))
                )
        return data

    def _key(self, node: Node, path: Path) -> str | None:
        is_text = isinstance(node, ScalarNode) and not is_number_list(node)
        if is_text and str(node.tag) == _TAG + "str":
            return str(node.value)
        found = str(node.value) if is_text else "a list or mapping"
        problem = f"the key {found} is not a text"
        remedy = "keys are words such as route"
        if str(node.tag) in (_TAG + "int", _TAG + "float"):
            remedy += "; a comma ends a value: write 0.1 for 0,1, and a place as [0, 1]"
        if str(node.tag) == _TAG + "merge":
            problem, remedy = "merge keys (<<) aren't supported", "write the keys out"
        self._faults.append(UnplacedFault(path, problem, remedy, mark=_mark(node)))
        return None

    def _scalar(self, node: ScalarNode, path: Path) -> Any:
        tag, text = str(node.tag), str(node.value)
        if not tag.startswith(_TAG):
            self._faults.append(_tagged(node, path))
        return plain_scalar(tag.removeprefix(_TAG), text)


MAX_DIGITS = 3000
"""Of a whole number that is one: Python writes none out that has more than 4,300 in base ten."""


def plain_scalar(kind: str, text: str) -> Any:
    """A YAML 1.2 scalar as a value of Python's.

    >>> plain_scalar("int", "0x10"), plain_scalar("float", "1e3"), plain_scalar("bool", "true")
    (16, 1000.0, True)
    """
    if kind == "null":
        return None
    if kind == "bool":
        return text.lower() in ("true", "yes", "on")
    digits = text.replace("_", "")
    try:
        if kind == "int" and len(digits) > MAX_DIGITS:
            return float("inf")
        if kind == "int":
            sign = digits.lstrip("+-").lower()
            return int(digits, 0 if sign.startswith(("0x", "0o", "0b")) else 10)
        if kind == "float":
            return float(digits.lower().replace(".inf", "inf").replace(".nan", "nan"))
    except ValueError:
        return float("inf") if kind == "int" else text
    return text


def _mark(node: Node) -> Mark:
    return Mark(node.start_mark.line + 1, node.start_mark.column + 1)


def _tagged(node: Node, path: Path) -> UnplacedFault:
    return UnplacedFault(
        path, f"the tag {node.tag} means nothing here", "leave it out", mark=_mark(node)
    )


def read_document(path: str | FilePath) -> Document:
    """The YAML document of a file.

    Raises:
        MissionError: There is no such file, or it isn't one YAML document in UTF-8.
    """
    return yaml_document(read_text(path, MISSION_FILE), str(path))


def yaml_document(text: str, source: str) -> Document:
    """The one YAML document of a text.

    Args:
        text: What the file holds.
        source: The file.

    Raises:
        MissionError: It isn't one YAML document with a mapping.
    """
    yaml = YAML(typ="safe", pure=True)
    yaml.Scanner = NumberListScanner
    try:
        nodes = list(yaml.compose_all(text))
    except TooManyPartsError as error:
        at = Mark(error.problem_mark.line + 1, error.problem_mark.column + 1)
        raise _fault(source, at, _TOO_MANY, MISSION_FILE.smaller) from None
    except MarkedYAMLError as error:
        raise _broken(source, text, error) from None
    except ReaderError as error:
        raise _fault(source, _place(text, error.position), *_character(error)) from None
    except RecursionError:
        problem = "lists or mappings are nested too deeply"
        raise _fault(source, Mark(1, 1), problem, _expected()) from None
    except (YAMLError, ValueError) as error:
        raise _fault(source, Mark(1, 1), f"is not YAML: {error}", _expected()) from None
    if not nodes or nodes[0] is None or _is_empty(nodes[0]):
        raise _fault(source, Mark(1, 1), "the file is empty", _expected())
    if len(nodes) > 1:
        problem, remedy = "a second document starts here", "a mission is one document: split it"
        raise _fault(source, _mark(nodes[1]), problem, remedy)
    try:
        document = Document(source, nodes[0])
    except RecursionError:
        problem = "lists or mappings are nested too deeply"
        raise _fault(source, Mark(1, 1), problem, _expected()) from None
    if not isinstance(document.data, dict):
        problem = f"the file holds {describe(document.data)}"
        raise _fault(source, _mark(nodes[0]), problem, _expected())
    return document


def _expected() -> str:
    from viaspline.mission.key_words import expectation

    return "it should be " + expectation(()).replace("a mapping", "a YAML mapping")


def _is_empty(node: Node) -> bool:
    return isinstance(node, ScalarNode) and str(node.tag) == _TAG + "null"


def _broken(source: str, text: str, error: MarkedYAMLError) -> MissionError:
    """A syntax error, in words for people who don't write scanners."""
    found = error.problem_mark or error.context_mark
    mark = Mark(found.line + 1, found.column + 1) if isinstance(found, StringMark) else Mark(1, 1)
    lines = text.splitlines()
    line = lines[mark.line - 1] if mark.line <= len(lines) else ""
    rest = line[mark.column - 1 :]
    problem = str(error.problem or error.context or "is not YAML")
    if "\\t" in problem or rest.startswith("\t"):
        return _fault(source, mark, "a tab can't be used to indent", "indent with spaces")
    context = f" {error.context}" if error.context and error.problem else ""
    remedy = "check the indentation, the brackets and the colons in and above this line"
    return _fault(source, mark, f"is not YAML: {problem}{context}", remedy)


def _character(error: ReaderError) -> tuple[str, str]:
    return f"the character {error.character!r} can't stand in YAML", "leave it out"


def _place(text: str, position: int) -> Mark:
    start = text.rfind("\n", 0, position) + 1
    return Mark(text.count("\n", 0, position) + 1, position - start + 1)


def _fault(source: str, mark: Mark | None, problem: str, remedy: str) -> MissionError:
    line, column = mark if mark is not None else (None, None)
    return MissionError([Fault("", problem, remedy, source, line, column)])
