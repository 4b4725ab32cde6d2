"""The elements of an SVG file, with the line and column at which each begins."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Final
from xml.parsers.expat import ExpatError, ParserCreate

from viaspline.maps.map_faults import refusal

_SVG: Final = "http://www.w3.org/2000/svg"
_DRAWING: Final = "give an SVG drawing"
DEEPEST: Final = 100
"""Elements inside each other; a drawing by hand or from a program has about ten."""

_LONGEST_ENTITY: Final = 200
"""Characters of an entity. Illustrator's are addresses; a bomb's are long, or made of others."""


@dataclass(eq=False)
class Element:
    """An element as it stands in the file.

    Attributes:
        tag: Its name; empty if it isn't one of SVG's.
        attributes: By their names; those of another namespace have it and a blank before.
        at: Line and column, from 1.
        children: The elements inside of it.
        text: What stands in it beside them.
    """

    tag: str
    attributes: dict[str, str]
    at: tuple[int, int]
    children: list[Element] = field(default_factory=list)
    text: str = ""


def read_tree(path: Path, text: str) -> Element:
    r"""The root of an SVG file.

    Nothing but the text itself is read: no entity of another file, and none that is made of others
    or long, so that what comes out is in proportion to what goes in.

    Args:
        path: The file, for faults.
        text: What it holds.

    Raises:
        MissionError: It is no XML or no SVG, declares such an entity, or is nested too deep; with
            line and column.

    >>> text = '<svg xmlns="http://www.w3.org/2000/svg">\n <g id="a"/></svg>'
    >>> read_tree(Path("a.svg"), text).children
    [Element(tag='g', attributes={'id': 'a'}, at=(2, 2), children=[], text='')]
    """
    builder = _Builder(path)
    try:
        builder.parser.Parse(text, True)
    except ExpatError as error:
        at = error.lineno, error.offset + 1
        problem = f"is not XML: {str(error).partition(':')[0]}"
        raise refusal(path, problem, _DRAWING, at=at) from None
    return builder.top.children[0]


class _Builder:
    """The tree as far as it has been read."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.top = Element("", {}, (1, 1))
        self._open = [self.top]
        self.parser = ParserCreate(namespace_separator=" ")
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = lambda _: self._open.pop()
        self.parser.CharacterDataHandler = self._data
        self.parser.EntityDeclHandler = self._entity

    @property
    def _at(self) -> tuple[int, int]:
        return self.parser.CurrentLineNumber, self.parser.CurrentColumnNumber + 1

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        space, _, tag = name.rpartition(" ")
        if len(self._open) == 1 and (space, tag) != (_SVG, "svg"):
            raise refusal(self.path, f"the file is <{tag}>", _DRAWING, at=self._at)
        if len(self._open) > DEEPEST:
            problem = f"more than {DEEPEST} elements lie inside each other"
            raise refusal(self.path, problem, "ungroup them", at=self._at)
        element = Element(tag if space == _SVG else "", attributes, self._at)
        self._open[-1].children.append(element)
        self._open.append(element)

    def _data(self, text: str) -> None:
        if self._open[-1].tag == "style":
            self._open[-1].text += text

    def _entity(self, name: str, is_parameter: bool, value: str | None, *_: str | None) -> None:
        is_short = value is not None and len(value) <= _LONGEST_ENTITY and "&" not in value
        if is_parameter or not is_short:
            problem = f"declares the entity {name!r}, which is another file, long or made of others"
            remedy = "save the drawing as plain SVG, without entities"
            raise refusal(self.path, problem, remedy, at=self._at)
