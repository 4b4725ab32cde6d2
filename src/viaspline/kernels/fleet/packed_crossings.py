"""Where the paths of a fleet come near each other, as the kernels of fleets see it.

Tested through ``fleet/test_crossings``.
"""

from __future__ import annotations

from typing import NamedTuple

from viaspline.kernels.arrays import Floats, Ints, Steps


class PackedCrossings(NamedTuple):
    """Every pair of places on two paths at which two robots would be too near each other.

    A *crossing* is a connected set of such pairs of places (s of the one, s of the other). Its
    *boxes* cover it from the side of either robot: while the one is in a cell, the other must not
    be between two distances along its own path. The boxes of robot r are ``box_first[r]`` to
    ``box_first[r + 1] - 1``, ordered by cell, then by the other robot, then by the lower distance.

    Attributes:
        robots: The two robots of each crossing, the one with the lower number first, (c, 2).
        span: Where the crossing begins and ends along the first's path and along the second's [m],
            (c, 4).
        box_first: (n + 1,).
        cell: The cell of a box, as the number of the node where it begins, (boxes,).
        crossing: Which crossing a box belongs to, (boxes,).
        other: Which robot must not be there meanwhile, (boxes,).
        low: From where along the other's path [m], (boxes,).
        high: To where [m], (boxes,).
    """

    robots: Ints
    span: Floats
    box_first: Ints
    cell: Steps
    crossing: Steps
    other: Steps
    low: Floats
    high: Floats
