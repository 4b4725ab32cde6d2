"""How fast moving obstacles go and turn at an instant.

Tested through ``robot/perception/moving/test_motion_sensor``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import kernel
from viaspline.kernels.motion.moving_distance import piece_at
from viaspline.kernels.motion.packed_motion import PRESENT, SPEED_X, SPEED_Y, TURNING, PackedMotion


@kernel
def rates_at(motion: PackedMotion, instant: float) -> Floats:
    """vx, vy [m/s] and yaw rate [rad/s] of all obstacles' frames at an instant [s], (n, 3).

    nan where an obstacle isn't there; at a keyframe it is the piece that begins there.
    """
    count = motion.first_piece.size - 1
    rates = np.full((count, 3), np.nan)
    for i in range(count):
        row, _, _ = piece_at(motion, i, instant)
        piece = motion.pieces[row]
        if piece[PRESENT] == 0.0:
            continue
        rates[i, 0] = piece[SPEED_X]
        rates[i, 1] = piece[SPEED_Y]
        rates[i, 2] = piece[TURNING]
    return rates
