"""Paths of SVG drawings: the ``d`` of those that are made of straight lines.

See https://www.w3.org/TR/SVG11/paths.html.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

import numpy as np

from viaspline.kernels.arrays import Floats

_NUMBER: Final = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_TOKEN: Final = re.compile(rf"[\s,]*(?:([A-Za-z])|({_NUMBER}))|[\s,]*(\S)")
_TAKES: Final = {"m": 2, "l": 2, "h": 1, "v": 1, "z": 0}
_CURVES: Final = "csqta"
_STRAIGHTEN: Final = "draw it with straight lines (in Inkscape: Extensions, Modify Path, Flatten)"
_CORRECT: Final = "correct its d"


class PathError(ValueError):
    """A path can't be followed.

    Attributes:
        problem: What is wrong with it.
        remedy: What to do about it.
    """

    def __init__(self, problem: str, remedy: str = _CORRECT) -> None:
        self.problem = problem
        self.remedy = remedy
        super().__init__(f"{problem}; {remedy}")


def rings_of_path(d: str) -> list[Floats]:
    """The rings of a path, one for each of its subpaths; a painter closes those that are open.

    Args:
        d: Commands m, l, h, v and z in upper and lower case.

    Returns:
        Corners in the drawing's own frame (y down), (n, 2) each.

    Raises:
        PathError: It has other commands, or is no path.

    >>> [ring.tolist() for ring in rings_of_path("m 1,1 h 2 v 1 z m 5,5 1,0 0,1")]
    [[[1.0, 1.0], [3.0, 1.0], [3.0, 2.0]], [[6.0, 6.0], [7.0, 6.0], [7.0, 7.0]]]
    """
    rings: list[list[tuple[float, float]]] = []
    x = y = 0.0
    is_closed = False
    for command, numbers in _steps(d):
        if command in "zZ":
            (x, y), is_closed = rings[-1][0], True
            continue
        dx, dy = (x, y) if command.islower() else (0.0, 0.0)
        kind = command.lower()
        x = numbers[0] + dx if kind != "v" else x
        y = numbers[-1] + dy if kind != "h" else y
        if kind == "m":
            rings.append([])
        elif is_closed:
            # Drawing goes on from where the last subpath began.
            rings.append([rings[-1][0]])
        rings[-1].append((x, y))
        is_closed = False
    return [np.array(ring) for ring in rings]


def _steps(d: str) -> Iterator[tuple[str, list[float]]]:
    """The commands, with the numbers of one step each."""
    command = ""
    numbers: list[float] = []
    is_done = True  # whether the command has had numbers for a step
    for letter, number, other in _TOKEN.findall(d):
        if other:
            raise PathError(f"has the character {other!r}")
        if letter:
            _check_command(letter, command)
            if numbers or not is_done:
                raise PathError(f"lacks a number after {command!r}")
            command, is_done = letter, letter in "zZ"
            if is_done:
                yield letter, []
            continue
        if command in ("", "z", "Z"):
            raise PathError(f"has the number {number} where a command should be")
        numbers.append(float(number))
        if len(numbers) == _TAKES[command.lower()]:
            yield command, numbers
            # More numbers after a move are lines.
            command = {"m": "l", "M": "L"}.get(command, command)
            numbers, is_done = [], True
    if numbers or not is_done:
        raise PathError(f"lacks a number after {command!r}")


def _check_command(letter: str, before: str) -> None:
    if letter.lower() in _CURVES:
        raise PathError(f"has a curve (command {letter!r})", _STRAIGHTEN)
    if letter.lower() not in _TAKES:
        raise PathError(f"has the unknown command {letter!r}")
    if not before and letter not in "mM":
        raise PathError(f"begins with {letter!r}, not with a move")
