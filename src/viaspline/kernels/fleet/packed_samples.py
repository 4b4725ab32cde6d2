"""Paths of a fleet looked at here and there, and when their robots are there.

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
        comes: When the robot comes there, by its law among the others [s], (m,).
        goes: When it goes on [s], (m,).
        alone: When it would come there and go on if it were alone [s], (m, 2).
        reach: How far each robot keeps others away on its part [m], (n,).
    """

    first: Ints
    robot: Ints
    distance: Floats
    place: Floats
    comes: Floats
    goes: Floats
    alone: Floats
    reach: Floats
