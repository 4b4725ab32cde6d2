"""Drawings of areas: SVG whose filled paths are made of straight lines.

One unit of the drawing is a metre, whatever unit its page is measured in, and y grows upwards: a
point of a path comes to lie at x + tx, -(y + ty), where tx and ty is what the groups around it
translate by. Bench-MR's polygon worlds (https://github.com/robot-motion/bench-mr) are meant so.

Each path is an area to keep clear of, also where it lies upon another or inside of it. Free areas
inside are drawn as one path with several subpaths, filled by SVG's rules.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Final
from xml.parsers.expat import ExpatError, ParserCreate

import numpy as np

from viaspline.errors import Fault, MissionError
from viaspline.maps.area import FARTHEST, Area, Rule, areas_of, distinct, filled, warn_of_nothing
from viaspline.maps.faults import refusal
from viaspline.maps.files import read_text
from viaspline.maps.svg_path import PathError, rings_of_path

_SVG: Final = "http://www.w3.org/2000/svg"
_LABEL: Final = "http://www.inkscape.org/namespaces/inkscape label"
_SHAPES: Final = frozenset(
    {"rect", "circle", "ellipse", "line", "polyline", "polygon", "image", "use", "text"}
)
_UNDRAWN: Final = frozenset(
    {"defs", "metadata", "clipPath", "mask", "marker", "pattern", "symbol", "style", "script"}
)
_TRANSLATE: Final = re.compile(
    r"\s*translate\(\s*([-+.\deE]+)(?:[\s,]+([-+.\deE]+))?\s*\)[\s,]*", re.ASCII
)


def read_svg(path: str | Path, unit: float = 1.0) -> tuple[Area, ...]:
    """Read the filled paths of a drawing.

    Args:
        path: The file.
        unit: Length of a unit of the drawing [m].

    Raises:
        MissionError: The file can't be read, is no SVG, or has shapes that aren't understood; all
            of them, with line and column.

    Warns:
        MissionWarning: For a path that encloses nothing.
    """
    file = Path(path)
    drawing = _Drawing(file, unit)
    drawing.parse(read_text(file))
    if drawing.faults:
        raise MissionError(drawing.faults)
    if not drawing.areas:
        raise refusal(file, "the drawing has no filled path", "draw what is to be kept clear of")
    return distinct(drawing.areas)


@dataclass(frozen=True)
class _Style:
    """What an element hands down to those inside of it."""

    shift: tuple[float, float] = (0.0, 0.0)
    fill: str = "black"
    rule: Rule = "nonzero"
    is_drawn: bool = True


class _Drawing:
    """A drawing as far as it has been read."""

    def __init__(self, path: Path, unit: float) -> None:
        self.path = path
        self.unit = unit
        self.areas: list[Area] = []
        self.faults: list[Fault] = []
        self._styles = [_Style()]
        self._parser = ParserCreate(namespace_separator=" ")
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = lambda _: self._styles.pop()

    def parse(self, text: str) -> None:
        try:
            self._parser.Parse(text, True)
        except ExpatError as error:
            at = error.lineno, error.offset + 1
            problem = f"is not XML: {str(error).partition(':')[0]}"
            raise refusal(self.path, problem, "give an SVG drawing", at=at) from None

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        space, _, tag = name.rpartition(" ")
        if len(self._styles) == 1 and (space, tag) != (_SVG, "svg"):
            at = self._parser.CurrentLineNumber, self._parser.CurrentColumnNumber + 1
            raise refusal(self.path, f"the file is <{tag}>", "give an SVG drawing", at=at)
        style = self._style(tag if space == _SVG else "", attributes)
        self._styles.append(style)
        if space != _SVG or not style.is_drawn:
            return
        if tag in _SHAPES:
            remedy = "make it a path (in Inkscape: Path, Object to Path), or leave it out"
            self._fault(f"<{tag}> isn't understood", remedy, attributes)
        if tag == "path":
            self._path(attributes, style)

    def _style(self, tag: str, attributes: dict[str, str]) -> _Style:
        outer = self._styles[-1]
        own = dict(attributes)
        for item in attributes.get("style", "").split(";"):
            key, _, value = item.partition(":")
            own[key.strip()] = value.strip()
        is_hidden = own.get("display") == "none" or own.get("visibility") == "hidden"
        return _Style(
            self._shift(outer.shift, attributes),
            own.get("fill", outer.fill),
            "evenodd" if own.get("fill-rule", outer.rule) == "evenodd" else "nonzero",
            outer.is_drawn and tag not in _UNDRAWN and not is_hidden,
        )

    def _shift(self, outer: tuple[float, float], attributes: dict[str, str]) -> tuple[float, float]:
        x, y = outer
        rest = attributes.get("transform", "")
        while rest.strip():
            found = _TRANSLATE.match(rest)
            try:
                if found is None:
                    raise ValueError
                x, y = x + float(found[1]), y + float(found[2] or 0)
            except ValueError:
                problem = f"the transform {rest.strip()} isn't understood"
                self._fault(problem, "apply it in the drawing; only translate is", attributes)
                return outer
            rest = rest[found.end() :]
        return x, y

    def _path(self, attributes: dict[str, str], style: _Style) -> None:
        if style.fill == "none":
            remedy = "fill it, or leave it out: only areas can be kept clear of"
            self._fault("the path isn't filled", remedy, attributes)
            return
        try:
            rings = rings_of_path(attributes.get("d", ""))
        except PathError as error:
            self._fault(f"the path {error.problem}", error.remedy, attributes)
            return
        x, y = style.shift
        placed = [np.add(ring, (x, y)) * (self.unit, -self.unit) for ring in rings]
        if any(not (np.abs(ring) <= FARTHEST).all() for ring in placed):
            problem = "the path has a coordinate that is too far away"
            self._fault(problem, f"it should be within {FARTHEST:g} m", attributes)
            return
        polygons = filled(placed, style.rule)
        if not polygons:
            warn_of_nothing(self.path, f"the path {attributes.get('id', '')}".strip())
        self.areas += areas_of(polygons, attributes.get(_LABEL))

    def _fault(self, problem: str, remedy: str, attributes: dict[str, str]) -> None:
        line, column = self._parser.CurrentLineNumber, self._parser.CurrentColumnNumber + 1
        key = attributes.get("id", "")
        self.faults.append(Fault(key, problem, remedy, str(self.path), line, column))
