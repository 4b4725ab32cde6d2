"""What an element of a drawing looks like, and what it hands down to those inside of it.

Tested through ``maps/test_svg``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from viaspline.maps.area import Rule
from viaspline.maps.svg_tree import Element

Sheet: TypeAlias = Mapping[str, Mapping[str, str]]
"""What style sheets declare, by selector."""


@dataclass(frozen=True)
class Style:
    """The part of a style that says what is filled.

    Attributes:
        fill: Its paint; ``none`` for none.
        rule: How SVG fills what several rings go round.
        visibility: ``visible`` or not.
    """

    fill: str = "black"
    rule: Rule = "nonzero"
    visibility: str = "visible"


def read_sheets(root: Element) -> Sheet:
    """The style sheets of a drawing: rules for ``*``, ``tag``, ``.class``, ``tag.class``, ``#id``.

    Rules with other selectors are left out.
    """
    sheet: dict[str, dict[str, str]] = {}
    for text in _sheets(root):
        # Cut at the marks, as a regular expression may take quadratic time.
        head, *comments = text.split("/*")
        plain = head + "".join(part.partition("*/")[2] for part in comments)
        for piece in plain.split("}"):
            selectors, _, declarations = piece.partition("{")
            for selector in selectors.split(","):
                sheet.setdefault(selector.strip(), {}).update(_declared(declarations))
    return sheet


def _sheets(element: Element) -> Iterator[str]:
    if element.tag == "style":
        yield element.text
    for child in element.children:
        yield from _sheets(child)


def _declared(text: str) -> dict[str, str]:
    """The declarations of a ``style`` attribute or a rule."""
    pairs = (item.partition(":") for item in text.split(";"))
    return {key.strip(): value.partition("!")[0].strip() for key, _, value in pairs}


def properties_of(element: Element, sheet: Sheet) -> dict[str, str]:
    """An element's attributes, under what style sheets and its own style say of it.

    >>> circle = Element("circle", {"r": "2", "fill": "red", "class": "hole"}, (1, 1))
    >>> properties_of(circle, {".hole": {"fill": "none"}, "circle": {"fill": "blue"}})["fill"]
    'none'
    """
    own = element.attributes
    classes = own.get("class", "").split()
    found: dict[str, str] = {**own, **sheet.get("*", {}), **sheet.get(element.tag, {})}
    for selector in (*(f".{name}" for name in classes), *(f"{element.tag}.{n}" for n in classes)):
        found.update(sheet.get(selector, {}))
    return {**found, **sheet.get(f"#{own.get('id')}", {}), **_declared(own.get("style", ""))}


def inherited(outer: Style, properties: Mapping[str, str]) -> Style:
    """The style of an element inside of one that has another."""

    def of(key: str, handed_down: str) -> str:
        value = properties.get(key, "inherit")
        return handed_down if value == "inherit" else value

    return Style(
        of("fill", outer.fill),
        "evenodd" if of("fill-rule", outer.rule) == "evenodd" else "nonzero",
        of("visibility", outer.visibility),
    )
