"""Lines and turns round those bends of a row that the others don't make needless.

Tested through ``kernels/turning/test_turn_sequence``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Floats, Ints
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.turning.guessed_lines import brought_near, guess_lines
from viaspline.kernels.turning.settled_lines import LEFT_OUT, RADIUS, SIDE, WRONG_TURN_RAD
from viaspline.kernels.turning.turn_sequence import lay_turns


@inner
def _needed(bends: Floats, closed: bool, turns: Floats, worst: int) -> Flags:
    """The bends that stay, (n,).

    Of neighbours that are turned at to the wrong side the one goes at which it is most so: without
    that one the others may be needed again. The worst of all is among those that go.
    """
    count = bends.shape[0]
    wrong, needed = np.minimum(bends[:, SIDE] * turns, 0.0), np.ones(count, np.bool_)
    if not closed:
        wrong[0] = wrong[-1] = 0.0
    for k in range(count):
        before, after = wrong[k - 1], wrong[(k + 1) % count]
        if wrong[k] < -WRONG_TURN_RAD and wrong[k] < before and wrong[k] <= after:
            needed[k] = False
    needed[worst] = False
    return needed


@kernel
def needed_turns(
    bends: Floats, closed: bool, ramp: float
) -> tuple[Ints, Floats, Floats, Floats, Floats, int, Ints]:
    """Lay lines and turns round a row of bends, without those that the others make needless.

    Args:
        bends: As in ``turn_sequence``.
        closed: The same.
        ramp: The same.

    Returns:
        Which bends are left, (m,), and of these what ``turn_sequence`` returns.
    """
    bends, x, y = brought_near(bends)
    left, count = np.arange(bends.shape[0]), bends.shape[0]
    lines, turns = np.zeros(count if closed else count - 1), np.zeros(count)
    circles = np.zeros((count, 3))
    guess_lines(bends, closed, lines, turns, circles)
    while True:
        apexes, ramps = np.zeros((left.size, 2)), ramp * bends[:, RADIUS]
        tight = np.zeros(lines.size, np.bool_)
        state, has_settled = lay_turns(bends, closed, ramps, lines, turns, circles, apexes, tight)
        if state != LEFT_OUT:
            for k in range(left.size):
                apexes[k, 0] += x
                apexes[k, 1] += y
            return left, lines, turns, apexes, ramps, state, np.flatnonzero(tight)
        needed = _needed(bends, closed, turns, np.flatnonzero(tight)[0])
        left, bends = left[needed], bends[needed]
        lines = lines[needed[: lines.size]][: left.size if closed else left.size - 1]
        turns, circles = turns[needed], circles[needed]
        if not has_settled:
            guess_lines(bends, closed, lines, turns, circles)
