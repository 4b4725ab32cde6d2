"""Lists of plain numbers within YAML, taken whole.

A scanner of YAML in Python takes some 40 µs for each number, and an outline of 100,000 corners has
200,000. So a list (of lists, of lists) that holds nothing but numbers, as JSON writes them too, is
found by a pattern and becomes one token; what its numbers are and where each of them stands is
asked only afterwards.

Tested through ``formats/test_yaml_document``.
"""

from __future__ import annotations

import json
import re
from typing import Any, Final, TypeAlias, TypeGuard

from ruamel.yaml.nodes import Node, ScalarNode
from ruamel.yaml.scanner import Scanner, ScannerError
from ruamel.yaml.tokens import ScalarToken

from viaspline.mission.unplaced_faults import Mark, Path

MAX_PARTS: Final = 1_500_000
"""Numbers, texts, keys and brackets of a document that are read: a minute's worth at the worst."""

_NUMBER: Final = r"-?(?:0|[1-9]\d{0,99})(?:\.\d{1,99})?(?:[eE][+-]?\d{1,9})?+(?![\w.+-])"
_GAP: Final = r"(?: |\r?\n)*+"


def _list_of(item: str, gap: str = _GAP) -> str:
    return rf"\[{gap}{item}{gap}(?:,{gap}{item}{gap})*+\]"


_ROW: Final = _list_of(_NUMBER)
_ROWS: Final = _list_of(_ROW)
_LINE: Final = _list_of(_NUMBER, " *+")
_LIST: Final = re.compile(rf"(?:{_list_of(_ROWS)}|{_ROWS}|{_ROW})(?! *:)")
_PART: Final = re.compile(r"[][]|[^][, \r\n]+")

Starts: TypeAlias = "tuple[int, list[Starts]]"
"""Where in the text of a list it begins, and its items."""


class TooManyPartsError(ScannerError):
    """A document has more than `MAX_PARTS`."""


class NumberListScanner(Scanner):
    """A scanner to which a list of plain numbers is one token."""

    numbers_taken: int = 0

    def fetch_more_tokens(self) -> Any:
        """As any scanner does, but not for ever."""
        if self.tokens_taken + self.numbers_taken > MAX_PARTS:
            raise TooManyPartsError(problem_mark=self.reader.get_mark())
        return super().fetch_more_tokens()

    def fetch_flow_sequence_start(self) -> None:
        """A list: whole if it holds plain numbers only."""
        found = _LIST.match(self.reader.buffer, self.reader.pointer)
        if found is None:
            super().fetch_flow_sequence_start()
        else:
            self.save_possible_simple_key()
            self._take(found[0])

    def fetch_block_entry(self) -> None:
        """The first of some lines ``- [1, 2]``: all of them if there are no others behind them."""
        reader, column = self.reader, self.reader.column
        found = None
        if not self.flow_level and self.allow_simple_key and self.indent < column:
            found = _lines(column).match(reader.buffer, reader.pointer)
        if found is None:
            super().fetch_block_entry()
        else:
            self._take(found[0])

    def _take(self, text: str) -> None:
        reader = self.reader
        self.allow_simple_key = False
        start = reader.get_mark()
        lines, column = _shift(text, len(text))
        reader.pointer += len(text)
        reader.index += len(text)
        reader.line += lines
        reader.column = column if lines else reader.column + column
        self.numbers_taken += count_of(text)
        self.tokens.append(ScalarToken(text, True, start, reader.get_mark()))


def _lines(column: int) -> re.Pattern[str]:
    """Lines of a block list that begin in the same column, each with a list of numbers."""
    line, behind = rf"- {_LINE} *+", rf"(?: *+(?:#[^\n]*+)?\r?\n)*+ {{{column}}}-"
    return re.compile(rf"{line}(?:\r?\n {{{column}}}{line})++(?=\r?\n(?!{behind})|\0)")


def _shift(text: str, end: int) -> tuple[int, int]:
    """How many lines, and then columns, a part of a text goes on."""
    return text.count("\n", 0, end), end - (text.rfind("\n", 0, end) + 1)


def count_of(text: str) -> int:
    """How many numbers a list has that was taken whole."""
    lines = text.count("\n") if text.startswith("-") else 0
    return text.count(",") + lines + 1


def is_number_list(node: Node) -> TypeGuard[ScalarNode]:
    """Whether a node is a list that was taken whole; no other plain scalar begins like one."""
    return (
        isinstance(node, ScalarNode) and node.style is None and node.value.startswith(("[", "- "))
    )


def numbers_of(node: ScalarNode) -> Any:
    """The numbers of a list that was taken whole, in lists."""
    if node.value[0] == "[":
        return json.loads(node.value)
    rows = (line.strip().removeprefix("-") for line in node.value.splitlines())
    return json.loads(f"[{','.join(rows)}]")


def starts_of(node: ScalarNode) -> Starts:
    """Where everything in a list begins that was taken whole.

    >>> node = ScalarNode("", "[[1, 2], [3]]", None, None)
    >>> starts_of(node)
    (0, [(1, [(2, []), (5, [])]), (9, [(10, [])])])
    """
    around: list[list[Starts]] = [[]]
    for part in _PART.finditer(node.value):
        if part[0] == "]":
            around.pop()
        elif part[0] != "-":
            here: Starts = (part.start(), [])
            around[-1].append(here)
            if part[0] == "[":
                around.append(here[1])
    return around[0][0] if node.value[0] == "[" else (0, around[0])


def mark_within(node: ScalarNode, starts: Starts, path: Path) -> Mark:
    """The place of the item at a path in a list that was taken whole, or of what is around it."""
    for step in path:
        if not isinstance(step, int) or step >= len(starts[1]):
            break
        starts = starts[1][step]
    lines, column = _shift(node.value, starts[0])
    start = node.start_mark
    return Mark(start.line + lines + 1, (0 if lines else start.column) + column + 1)
