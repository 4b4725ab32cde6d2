"""Who lets whom pass where, as the kernels that drive a fleet see it.

Tested through ``fleet/execution/test_fleet_orders``.
"""

from __future__ import annotations

from typing import NamedTuple

from viaspline.kernels.arrays import Flags, Floats, Ints, Steps


class PackedOrders(NamedTuple):
    """The bars of a fleet: places that a robot must not pass before another one has come far.

    Every crossing has bars for both of its robots, and only those of the second one count: whose
    ``other`` is the leader of the crossing. The bars of robot r are ``first[r]`` to
    ``first[r + 1] - 1``, ordered by place, then by crossing. Of one crossing each asks for more
    than those before it.

    Attributes:
        first: (n + 1,).
        place: Beyond which the robot must not go [m], (bars,).
        other: Before this robot, (bars,),
        passed: has come here along its own path [m]; infinite: has left the world, (bars,).
        crossing: Which crossing it is for, (bars,).
        comes: When the robot comes to the bar if it never waits [s since it set out], (bars,).
        other_comes: When the other one comes where it has passed, likewise [s], (bars,).
        robots: The two robots of each crossing, (c, 2).
        final: The farthest that a bar of each of them asks the other to have come [m]; minus
            infinity: it has none, (c, 2).
        most: The most by which the other comes later past such a bar than it comes to it, if none
            ever waits and both set out at once [s]; likewise, (c, 2).
        may_lead: Whether each of them may pass first, (c, 2): it must not rest in the crossing,
            nor the other one begin in it.
        length: Of the robots' paths [m], (n,).
        vanishes: Whether a robot leaves the world when it arrives, (n,).
        short: How far before a bar, but not before its end, each may stand and be believed to be
            farther back still [m], (n,).
    """

    first: Ints
    place: Floats
    other: Steps
    passed: Floats
    crossing: Steps
    comes: Floats
    other_comes: Floats
    robots: Ints
    final: Floats
    most: Floats
    may_lead: Flags
    length: Floats
    vanishes: Flags
    short: Floats
