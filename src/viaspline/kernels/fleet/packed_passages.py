"""Crossings as each robot passes them, as the kernels of fleets see it.

Tested through ``kernels/fleet/test_passages``.
"""

from __future__ import annotations

from typing import NamedTuple

from viaspline.kernels.arrays import Floats, Ints, Steps


class PackedPassages(NamedTuple):
    """Every crossing twice, from the side of either robot: that robot's *passage* of it.

    The passages of robot r are ``first[r]`` to ``first[r + 1] - 1``, in the order of their first
    boxes, so their entries never decrease.

    Attributes:
        first: (n + 1,).
        crossing: (p,).
        other: The other robot, (p,).
        entry: The first cell of the robot's own path in which it has a box, (p,).
        exit: The last one, (p,).
        low: The cell of the other's path in which what is too near begins, (p,).
        high: The one in which that ends, (p,).
        box_first: Where the boxes of a passage begin in ``box``, (p + 1,).
        box: The boxes of the fleet's crossings, passage by passage, increasing in each, (boxes,).
        cell: Their cells, (boxes,).
        interval: From where to where along the other's path they are [m], (boxes, 2).
    """

    first: Ints
    crossing: Ints
    other: Ints
    entry: Ints
    exit: Ints
    low: Ints
    high: Ints
    box_first: Ints
    box: Steps
    cell: Steps
    interval: Floats
