"""Moving obstacles as kernels see them: shapes in frames of their own, and how the frames move.

The motion of an obstacle is a row of pieces, in each of which its frame goes straight on and turns
evenly. The pieces of one that goes on and on cover one period, which is repeated in both directions
of time; those of any other cover all of time.

Tested through ``world/test_moving_obstacles``.
"""

from __future__ import annotations

from typing import Final, NamedTuple

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.world.packed import PackedWorld

BEGINS: Final = 0  # when the piece begins [s]; -inf: it has always been going
KNOWN: Final = 1  # the time at which its place is known [s]
X: Final = 2  # the frame's origin then [m]
Y: Final = 3
HEADING: Final = 4  # by which the frame is turned then, anticlockwise [rad]
SPEED_X: Final = 5  # [m/s]
SPEED_Y: Final = 6
TURNING: Final = 7  # [rad/s]
PRESENT: Final = 8  # 1: it is there; 0: it isn't
COLUMNS: Final = 9

SINCE: Final = 0  # from when on the place gets less certain [s]
UNCERTAIN: Final = 1  # how far from its place it may be until then [m]
GROWTH: Final = 2  # by how much that grows in a second [m/s]


class PackedMotion(NamedTuple):
    """Obstacles that move.

    Attributes:
        shapes: The obstacles, each in its own frame.
        first_piece: Obstacle i has the pieces ``first_piece[i]:first_piece[i + 1]``, (n + 1,).
        pieces: In the order of time, each until the next one begins, (p, COLUMNS).
        rounds: When the first piece of an obstacle begins and how long all of them take together
            [s]; a period of 0: it doesn't go on and on, (n, 2).
        errors: SINCE, UNCERTAIN, GROWTH, (n, 3).
        reaches: From the frame's origin to the farthest point of the shape [m], (n,).
        speeds: The greatest speed of any point of the shape [m/s], (n,); a jump is none.
    """

    shapes: PackedWorld
    first_piece: Ints
    pieces: Floats
    rounds: Floats
    errors: Floats
    reaches: Floats
    speeds: Floats
