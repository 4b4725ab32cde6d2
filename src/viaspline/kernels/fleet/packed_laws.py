"""When every robot of a fleet is where, as the kernels of fleets see it.

Tested through ``fleet/test_fleet_certificate``.
"""

from __future__ import annotations

from typing import NamedTuple

from viaspline.kernels.arrays import Flags, Floats


class PackedLaws(NamedTuple):
    """The time laws of a fleet, at the nodes of its courses.

    Between a node and the next the acceleration is constant. At its first node a robot stands from
    the beginning of time, at its last one for ever, or, if it leaves, until it has arrived.

    Attributes:
        arrive: When a robot comes to a node [s], (nodes,).
        leave: When it goes on from there [s], (nodes,); at its last node infinite, or the time at
            which it leaves the world.
        speed: There [m/s], (nodes,).
        is_timed: Whether a robot has a law, (n,); the others play no part.
    """

    arrive: Floats
    leave: Floats
    speed: Floats
    is_timed: Flags
