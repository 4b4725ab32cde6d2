"""Paths of a fleet looked at here and there, and when their robots are there if all drive alone.

Tested through ``fleet/test_swerved_fleet``.
"""

from __future__ import annotations

from typing import NamedTuple

from viaspline.kernels.arrays import Floats, Ints


class PackedSamples(NamedTuple):
    """Places on the paths of robots, in the order in which each robot passes them.

    The samples of robot r are ``first[r]`` to ``first[r + 1] - 1``.

    Attributes:
        first: (n + 1,).
        robot: Of each sample, (m,).
        distance: Along the path of the robot [m], (m,).
        place: [m], (m, 2).
        comes: When the robot comes there [s], (m,).
        goes: When it goes on [s], (m,).
        reach: How far each robot keeps others away on its part [m], (n,).
    """

    first: Ints
    robot: Ints
    distance: Floats
    place: Floats
    comes: Floats
    goes: Floats
    reach: Floats
