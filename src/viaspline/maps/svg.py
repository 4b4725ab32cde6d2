"""Drawings of areas: the filled shapes of an SVG file.

One unit of the drawing is a metre (or as long as is asked for), whatever page it is on: the size
and the ``viewBox`` of the page play no part. Lengths with a unit are what CSS makes of them, 96
units for an inch: 10mm are 37.8 units. y grows upwards: a point of the drawing comes to lie at
x, -y, after the transforms of the shape and of the groups around it. Bench-MR's polygon worlds
(https://github.com/robot-motion/bench-mr) are meant so.

A curve becomes chords that are nowhere farther from it than 5 mm, nor than a thousandth of the
drawing's longer side (in a drawing of more than 50 km: a ten-millionth of it). By as much, and no
more, a round area may be free at its edge that is drawn as blocked.

Each shape is an area to keep clear of, also where it lies upon another or inside of it. Free areas
inside are drawn as one path with several subpaths, filled by SVG's rules. Strokes have no width;
clips, masks and opacity play no part: what they would hide is blocked.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np

from viaspline.bounded_file import MAP_FILE, read_text
from viaspline.errors import Fault, MissionError
from viaspline.kernels.arrays import Floats
from viaspline.maps.area import (
    FARTHEST_M,
    Area,
    Rule,
    areas_of,
    distinct,
    filled,
    warn_of_nothing,
)
from viaspline.maps.map_faults import refusal
from viaspline.maps.svg_outline import (
    TOO_FAR,
    OutlineError,
    flattened,
    hull_of,
    length_of,
    matrix_of,
    segments_of,
)
from viaspline.maps.svg_style import Style, inherited, properties_of, read_sheets
from viaspline.maps.svg_tree import DEEPEST, Element, read_tree

CHORD_ERROR_M: Final = 5e-3
"""How far a curve may be from the chords in its place [m]."""

CHORD_ERROR_SHARE: Final = 1e-3
"""How far, as a part of the drawing's longer side; the smaller of the two holds."""

LEAST_CHORD_ERROR_SHARE: Final = 1e-7
"""It is never less than this part of that side: a curve has some thousand chords at most."""

MOST_ELEMENTS: Final = 100_000
"""That are drawn; an element counts each time that it is used."""

_LABEL: Final = "http://www.inkscape.org/namespaces/inkscape label"
_LINKS: Final = ("href", "http://www.w3.org/1999/xlink href")
_SHAPES: Final = frozenset({"path", "rect", "circle", "ellipse", "polygon", "polyline"})
_GROUPS: Final = frozenset({"g", "a", "switch", "svg"})
_OTHERS: Final = frozenset({"line", "image", "text"})
_AS_PATH: Final = "make it a path (in Inkscape: Path, Object to Path), or leave it out"
_UNLINK: Final = "make it a path (in Inkscape: Edit, Clone, Unlink Clone), or leave it out"


def read_svg(path: str | Path, unit: float = 1.0) -> tuple[Area, ...]:
    """Read the filled shapes of a drawing: paths, rectangles, circles, ellipses and polygons.

    Args:
        path: The file.
        unit: Length of a unit of the drawing [m].

    Raises:
        MissionError: The file can't be read, is no SVG, or has shapes that aren't understood; all
            of them, with line and column.

    Warns:
        MissionWarning: For a shape that encloses nothing.
    """
    file = Path(path)
    drawing = _Drawing(file, read_tree(file, read_text(file, MAP_FILE)))
    drawing.draw(drawing.root, Style(), np.diag((unit, -unit, 1.0)))
    if drawing.faults:
        raise MissionError(drawing.faults)
    areas = _areas(file, drawing.outlines)
    if not areas:
        raise refusal(file, "the drawing has no filled path", "draw what is to be kept clear of")
    return distinct(areas)


class _Outline(NamedTuple):
    """A filled shape: its segments, what brings them to the plane, and where they come to lie."""

    element: Element
    segments: tuple[Any, ...]
    matrix: Floats
    hull: Floats
    rule: Rule


class _Drawing:
    """A drawing as far as it has been followed."""

    def __init__(self, path: Path, root: Element) -> None:
        self.path = path
        self.root = root
        self.outlines: list[_Outline] = []
        self.faults: list[Fault] = []
        self._sheet = read_sheets(root)
        self._named: dict[str, Element] = {}
        self._note(root)
        self._used: list[Element] = []
        self._count = 0

    def _note(self, element: Element) -> None:
        self._named.setdefault(element.attributes.get("id", ""), element)
        for child in element.children:
            self._note(child)

    def draw(self, element: Element, outer: Style, matrix: Floats, depth: int = 1) -> None:
        """Collect the outlines of an element and of all inside of it, and what is wrong there."""
        self._count += 1
        if self._count > MOST_ELEMENTS:
            problem = f"the drawing has more than {MOST_ELEMENTS} elements"
            raise refusal(self.path, problem, "draw what is to be kept clear of, and no more")
        own = properties_of(element, self._sheet)
        if own.get("display") == "none":
            return
        try:
            if depth > DEEPEST:
                raise OutlineError(f"more than {DEEPEST} elements lie inside each other", _UNLINK)
            moved = matrix @ matrix_of(own.get("transform", ""))
            self._follow(element, own, inherited(outer, own), moved, depth)
        except OutlineError as error:
            key = element.attributes.get("id", "")
            fault = Fault(key, error.problem, error.remedy, str(self.path), *element.at)
            if fault not in self.faults:  # what is used twice is wrong once
                self.faults.append(fault)

    def _follow(
        self, element: Element, own: Mapping[str, str], style: Style, matrix: Floats, depth: int
    ) -> None:
        tag, is_visible = element.tag, style.visibility == "visible"
        if tag in _GROUPS:
            if tag == "svg" and depth > 1 and own.keys() & {"x", "y", "viewBox"}:
                raise OutlineError("a drawing lies inside of the drawing", "ungroup it")
            for child in element.children:
                self.draw(child, style, matrix, depth + 1)
        elif tag == "use":
            self._use(own, style, matrix, depth)
        elif tag in _OTHERS and is_visible:
            raise OutlineError(f"<{tag}> isn't understood", _AS_PATH)
        elif tag in _SHAPES and is_visible:
            if style.fill == "none":
                remedy = "fill it, or leave it out: only areas can be kept clear of"
                raise OutlineError(f"the {tag} isn't filled", remedy)
            segments = segments_of(tag, own)
            hull = hull_of(segments, matrix)
            if not (np.abs(hull) <= FARTHEST_M).all():
                raise OutlineError(f"the {tag} has a coordinate that is too far away", TOO_FAR)
            self.outlines.append(_Outline(element, segments, matrix, hull, style.rule))

    def _use(self, own: Mapping[str, str], style: Style, matrix: Floats, depth: int) -> None:
        """Draw an element of the drawing once more, moved."""
        link = next((own[key] for key in _LINKS if key in own), "")
        target = self._named.get(link[1:]) if len(link) > 1 and link[0] == "#" else None
        problem = None
        if target is None:
            problem = "which isn't in the drawing"
        elif target in self._used:
            problem = "which it is a part of"
        elif target.tag == "symbol" and "viewBox" in target.attributes:
            problem = "which has a viewBox"
        if target is None or problem is not None:
            raise OutlineError(f"<use> refers to {link!r}, {problem}", _UNLINK)
        moved = np.eye(3)
        moved[:2, 2] = length_of("x", own), length_of("y", own)
        self._used.append(target)
        drawn = replace(target, tag="g") if target.tag == "symbol" else target
        self.draw(drawn, style, matrix @ moved, depth + 1)
        self._used.pop()


def _areas(path: Path, outlines: Sequence[_Outline]) -> list[Area]:
    """What outlines go round."""
    corners = np.vstack([np.zeros((0, 2)), *(outline.hull for outline in outlines)])
    size = float(np.ptp(corners, axis=0).max()) if corners.size else 0.0
    error = max(min(CHORD_ERROR_M, CHORD_ERROR_SHARE * size), LEAST_CHORD_ERROR_SHARE * size)
    areas: list[Area] = []
    for element, segments, matrix, _, rule in outlines:
        polygons = filled(flattened(segments, matrix, error or CHORD_ERROR_M), rule)
        if not polygons:
            name = element.attributes.get("id", "")
            warn_of_nothing(path, f"the {element.tag} {name}".strip())
        areas += areas_of(polygons, element.attributes.get(_LABEL))
    return areas
