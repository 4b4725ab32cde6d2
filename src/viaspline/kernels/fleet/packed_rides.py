"""How the robots of a fleet would drive alone, as the kernels of fleets see it.

Tested through ``kernels/fleet/test_yielding_ride``.
"""

from __future__ import annotations

from typing import NamedTuple

from viaspline.kernels.arrays import Flags, Floats


class PackedRides(NamedTuple):
    """The fastest law of every robot where it is alone, at the nodes of the fleet's courses.

    Attributes:
        square: Of the speed at each node [m²/s²], (nodes,).
        lasts: How long the cell that begins at a node takes [s], (nodes,); 0 at a last node.
        stays: How long the robot has to stand at a node [s], (nodes,).
        accel: By how much it may speed up [m/s²], (n,).
        brake: By how much it may slow down [m/s²], (n,).
        depart: When it may set out [s], (n,).
        keeps_pace: Whether it can't slow down on the way: it waits where it stands anyway, (n,).
        vanishes: Whether it leaves the world when it has arrived and stood there, (n,).
    """

    square: Floats
    lasts: Floats
    stays: Floats
    accel: Floats
    brake: Floats
    depart: Floats
    keeps_pace: Flags
    vanishes: Flags
