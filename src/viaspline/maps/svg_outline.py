"""Outlines of SVG's shapes: segments by svgelements, and rings of straight lines in their place.

svgelements passes over what it can't read: of ``M0 0 9 0 9 x 9`` it draws what comes before the x,
and a width of ``abc`` becomes the default. So the words are checked here before it is asked.

See https://www.w3.org/TR/SVG11/paths.html and https://www.w3.org/TR/SVG11/coords.html.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.maps.area import FARTHEST_M

PIXELS_PER_INCH: Final = 96.0
"""CSS: what makes a length with a unit a number of the drawing's own units."""

TOO_FAR: Final = f"it should be within {FARTHEST_M:g} m"

_LARGEST: Final = 1e30  # of the numbers that are calculated with
_NUMBER: Final = r"(?>[+-]?(?:\d*\.)?\d+(?:[eE][+-]?\d+)?)"  # never only a part of a number
_NEXT: Final = rf"[\s,]*{_NUMBER}"
_ARC: Final = rf"{_NEXT}{_NEXT}{_NEXT}[\s,]*[01][\s,]*[01]{_NEXT}{_NEXT}"
_FINAL_DOT: Final = re.compile(r"(?<=\d)\.(?!\d)")
_COMMAND: Final = re.compile(rf"[\s,]*(?:([A-Za-z])((?:{_NEXT})*)|({_NUMBER})|(\S))", re.ASCII)
_TAKES: Final = {"m": 2, "l": 2, "h": 1, "v": 1, "z": 0, "c": 6, "s": 4, "q": 4, "t": 2, "a": 7}
_PAIRS: Final = re.compile(rf"(?:{_NEXT}{_NEXT})*[\s,]*", re.ASCII)
_LENGTH: Final = re.compile(rf"\s*{_NUMBER}(?:px|mm|cm|in|pt|pc)?\s*", re.ASCII)
_SIZES: Final = ("width", "height", "r", "rx", "ry")
_LENGTHS: Final = ("x", "y", "cx", "cy", *_SIZES)
_CORNERS: Final = {
    "QuadraticBezier": ("start", "control", "end"),
    "CubicBezier": ("start", "control1", "control2", "end"),
}
_NUMBERS_OF: Final = (
    ("matrix", 6), ("translate", 1), ("translate", 2), ("scale", 1), ("scale", 2),
    ("rotate", 1), ("rotate", 3), ("skewX", 1), ("skewY", 1),
)  # fmt: skip
_CALLS: Final = "|".join(rf"{name}\s*\((?:{_NEXT}){{{n}}}\s*\)" for name, n in _NUMBERS_OF)
_TRANSFORM: Final = re.compile(rf"(?:[\s,]*(?:{_CALLS}))*[\s,]*", re.ASCII)


class OutlineError(ValueError):
    """A shape can't be followed.

    Attributes:
        problem: What is wrong with it.
        remedy: What to do about it.
    """

    def __init__(self, problem: str, remedy: str) -> None:
        self.problem = problem
        self.remedy = remedy
        super().__init__(f"{problem}; {remedy}")


def matrix_of(transform: str) -> Floats:
    """The matrix of a ``transform``, (3, 3).

    Raises:
        OutlineError: It isn't one of SVG 1.1's.

    >>> matrix_of("translate(1, 2) scale(3)").tolist()
    [[3.0, 0.0, 1.0], [0.0, 3.0, 2.0], [0.0, 0.0, 1.0]]
    """
    from svgelements import Matrix

    text = _plain(transform)
    if _TRANSFORM.fullmatch(text) is None:
        remedy = "give matrix, translate, scale, rotate, skewX or skewY with numbers"
        raise OutlineError(f"the transform {transform.strip()} isn't understood", remedy)
    m = Matrix(text)
    return np.array([(m.a, m.c, m.e), (m.b, m.d, m.f), (0.0, 0.0, 1.0)], np.float64)


def length_of(key: str, attributes: Mapping[str, str]) -> float:
    """A length in the drawing's units; 0 if it isn't given.

    Raises:
        OutlineError: It is no number with one of the units that have a size, or a size below 0.

    >>> round(length_of("width", {"width": "25.4mm"}), 3)
    96.0
    """
    from svgelements import Length

    text = _plain(attributes.get(key, "0"))
    if _LENGTH.fullmatch(text) is None or (key in _SIZES and text.strip().startswith("-")):
        least = " of at least 0" if key in _SIZES else ""
        remedy = f"it should be a number{least}, with px, mm, cm, in, pt, pc or no unit"
        raise OutlineError(f"the {key} {attributes[key]!r} isn't understood", remedy)
    return float(Length(text.strip()).value(ppi=PIXELS_PER_INCH))


def segments_of(tag: str, attributes: Mapping[str, str]) -> tuple[Any, ...]:
    """The outline of a path, rect, circle, ellipse, polygon or polyline, before its transform.

    Returns:
        Segments of svgelements, in the drawing's units.

    Raises:
        OutlineError: It can't be followed.

    >>> [type(each).__name__ for each in segments_of("path", {"d": "m 1,1 q 1,1 2,0 z"})]
    ['Move', 'QuadraticBezier', 'Close']
    """
    from svgelements import Circle, Ellipse, Path, Rect

    if tag == "path":
        d = _plain(attributes.get("d", ""))
        _check_path(d)
        return tuple(Path(d))
    if tag in ("polygon", "polyline"):
        points = _plain(attributes.get("points", ""))
        if _PAIRS.fullmatch(points) is None:
            raise OutlineError(f"the {tag} has points that aren't pairs of numbers", "correct them")
        return tuple(Path(f"M{points}z")) if points.strip() else ()
    values = {key: length_of(key, attributes) for key in _LENGTHS if key in attributes}
    shape = {"rect": Rect, "circle": Circle, "ellipse": Ellipse}[tag]
    missing = {"circle": {"r": 0.0}, "ellipse": {"rx": 0.0, "ry": 0.0}}.get(tag, {})
    return tuple(shape(missing | values).segments(transformed=False))


def _plain(text: str) -> str:
    """Numbers as svgelements reads them: without a point at their end."""
    if any(abs(float(number)) > _LARGEST for number in re.findall(_NUMBER, text)):
        raise OutlineError("there is a coordinate that is too far away", TOO_FAR)
    return _FINAL_DOT.sub("", text)


def _check_path(d: str) -> None:
    remedy = "correct its d"
    is_begun = False
    for letter, text, number, other in _COMMAND.findall(d):
        numbers = re.findall(_NUMBER, text)
        takes = _TAKES.get(letter.lower())
        if other:
            raise OutlineError(f"the path has the character {other!r}", remedy)
        if letter and takes is None:
            raise OutlineError(f"the path has the unknown command {letter!r}", remedy)
        if letter and not is_begun and letter not in "mM":
            raise OutlineError(f"the path begins with {letter!r}, not with a move", remedy)
        if number or (takes == 0 and numbers):
            place = f"the number {number or numbers[0]} where a command should be"
            raise OutlineError(f"the path has {place}", remedy)
        is_begun = True
        steps = _ARC if letter in "aA" else _NEXT * (takes or 0)
        if takes and re.fullmatch(rf"(?:{steps})+", text) is None:
            # More numbers after a move are lines.
            last = {"m": "l", "M": "L"}.get(letter, letter) if len(numbers) > takes else letter
            raise OutlineError(f"the path lacks a number after {last!r}", remedy)


def flattened(segments: Sequence[Any], matrix: Floats, error: float) -> list[Floats]:
    """Rings in the place of an outline, one for each subpath; a painter closes those that are open.

    Args:
        segments: As `segments_of` gives them.
        matrix: What brings them to the plane, (3, 3).
        error: The farthest that a curve may be from the chords in its place, in the plane's unit.

    Returns:
        Corners in the plane, (n, 2) each.
    """
    stretch = float(np.linalg.norm(matrix[:2, :2], 2))  # its largest singular value
    rings: list[list[Floats]] = []
    before = "Close"
    for segment in segments:
        kind = type(segment).__name__
        if kind == "Move" or before == "Close":
            # Drawing goes on from where the last subpath began.
            rings.append([np.array([segment.end if kind == "Move" else segment.start])])
        if kind not in ("Move", "Close"):
            steps = math.ceil(math.sqrt(stretch * _bend(kind, segment) / (8.0 * error))) or 1
            places = segment.npoint(np.arange(1, steps + 1) / steps)
            rings[-1].append(np.array([(x, y) for x, y in places], np.float64))
        before = kind
    return [_placed(np.vstack(ring), matrix) for ring in rings]


def hull_of(segments: Sequence[Any], matrix: Floats) -> Floats:
    """Places in the plane whose box has all of an outline in it, (n, 2)."""
    points: list[Any] = []
    for segment in segments:
        names = _CORNERS.get(type(segment).__name__, ("end",))
        points += [getattr(segment, name) for name in names]
        if hasattr(segment, "sweep"):
            (x, y), far = segment.center, max(segment.rx, segment.ry)
            points += [(x + i * far, y + j * far) for i in (-1, 1) for j in (-1, 1)]
    with np.errstate(over="ignore", invalid="ignore"):
        return _placed(np.array(points, np.float64).reshape(-1, 2), matrix)


def _placed(points: Floats, matrix: Floats) -> Floats:
    return np.asarray(points @ matrix[:2, :2].T + matrix[:2, 2])


def _bend(kind: str, segment: Any) -> float:
    """The greatest second derivative of a segment by its parameter.

    Over a step of h, a chord is nowhere farther from the curve than an eighth of it times h².
    """
    if kind == "Arc":
        return float(segment.sweep**2 * max(segment.rx, segment.ry))
    corners = _CORNERS.get(kind)
    if corners is None:
        return 0.0
    points = np.array([getattr(segment, corner) for corner in corners], np.float64)
    order = len(points) - 1
    largest = np.linalg.norm(np.diff(points, 2, axis=0), axis=1).max()
    return float(order * (order - 1) * largest)
