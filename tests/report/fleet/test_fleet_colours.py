"""Colours are told apart on white paper, by every common kind of eyes."""

from __future__ import annotations

from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from viaspline.report.fleet.fleet_colours import ROBOT_COLOURS, colours_of

TO_XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
DEUTERANOPIA = np.array(  # Machado, Oliveira and Fernandes 2009, severity 1
    [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413],
     [-0.011820, 0.042940, 0.968881]]
)  # fmt: skip


def lab(colour: str, eyes: NDArray[np.float64]) -> NDArray[np.float64]:
    """CIELAB of a colour as some eyes see it."""
    rgb = np.array([int(colour[i : i + 2], 16) for i in (1, 3, 5)]) / 255
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    xyz = TO_XYZ @ np.clip(eyes @ linear, 0, 1) / np.array([0.9505, 1.0, 1.089])
    f = np.where(xyz > 0.008856, np.cbrt(xyz), 7.787 * xyz + 16 / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


def nearest(colours: tuple[str, ...], eyes: NDArray[np.float64]) -> float:
    seen = [lab(colour, eyes) for colour in colours]
    return min(float(np.linalg.norm(a - b)) for a, b in combinations(seen, 2))


def test_any_two_colours_differ() -> None:
    assert nearest(ROBOT_COLOURS, np.eye(3)) > 25.0


def test_the_first_colours_differ_without_green_as_well() -> None:
    assert nearest(ROBOT_COLOURS[:6], DEUTERANOPIA) > 15.0


def test_no_colour_is_too_pale_for_a_line_on_white_paper() -> None:
    assert max(lab(colour, np.eye(3))[0] for colour in ROBOT_COLOURS) < 75.0


def test_a_thousand_robots_have_colours() -> None:
    assert set(colours_of(1000)) == set(ROBOT_COLOURS)
    assert colours_of(0) == []
