import math

import numpy as np
import pytest

from viaspline.kernels.turning.hybrid_astar.primitives import LEVELS, WAYS, primitives_of

RHO, STEP = 4.0, 0.8


@pytest.mark.parametrize("ramp", [0.3, 1.0, 1.6])
def test_every_move_follows_its_segments_from_level_to_level(chained, ramp):
    moves = primitives_of(RHO, ramp, np.array([STEP, 2.5 * STEP]), 0.02)
    for row in range(2 * LEVELS * WAYS):
        scale, level, way = np.unravel_index(row, (2, LEVELS, WAYS))
        step, pace, count = moves.scales[scale]
        last = moves.places[row, int(count) - 1]
        segments = moves.segments[row]
        assert step == pytest.approx(STEP * (1.0, 2.5)[scale])
        assert (pace <= 0.02, pace * count) == (True, pytest.approx(step))
        assert segments[:, 2].sum() == pytest.approx(step)
        assert segments[0, 0] * RHO == pytest.approx((level - 2) / 2)
        assert segments[1, 1] * RHO == pytest.approx((level + way - 3) / 2)
        x, y, heading = chained(segments)
        assert last[:2] == pytest.approx((x[-1], y[-1]), abs=1e-6)
        assert moves.turns[row] == pytest.approx(heading[-1])
        assert math.atan2(last[3], last[2]) == pytest.approx(heading[-1])
