"""Random numbers that are the same everywhere: Park and Miller's generator.

Tested through ``kernels/fleet/test_prioritised_planning``.
"""

from __future__ import annotations

from viaspline.kernels.arrays import Ints
from viaspline.kernels.jit import inlined


@inlined
def random_below(state: Ints, count: int) -> int:
    """A number from 0 to ``count`` - 1; ``state``, (1,), is between 1 and 2147483646."""
    state[0] = state[0] * 48271 % 2147483647
    return state[0] % count
