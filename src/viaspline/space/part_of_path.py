"""A part of a path that may be no more than a place.

A flight that lands right under the place where it hovers, or where it took off, is airborne at that
place alone.

Tested through ``space/test_solve_route``.
"""

from __future__ import annotations

import numpy as np

from viaspline.curve.path import Path
from viaspline.curve.piecewise import PiecewiseCubic


def part_of_path(path: Path, first: float, last: float) -> PiecewiseCubic:
    """A part of a path; where that has no length, a curve that stands at its place.

    Args:
        path: It.
        first: Where the part begins, a parameter.
        last: Where it ends.

    >>> line = Path([[[0, 0, 1], [1, 0, 1], [2, 0, 1], [3, 0, 1]]], vias=[])
    >>> part_of_path(line, 0.5, 0.5).spans.tolist()
    [[[1.5, 0.0, 1.0], [1.5, 0.0, 1.0], [1.5, 0.0, 1.0], [1.5, 0.0, 1.0]]]
    """
    if last > first:
        return path.section(first, last)
    return PiecewiseCubic(np.tile(np.asarray(path.evaluate(first)), (1, 4, 1)))
