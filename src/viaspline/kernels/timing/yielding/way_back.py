"""From an arrival on a lattice of times, speeds and places back to where it began.

Tested through ``trajectory/yielding/test_law_among``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Ints
from viaspline.kernels.jit import inner, kernel
from viaspline.kernels.timing.yielding.bit_rows import Words, has_place
from viaspline.kernels.timing.yielding.time_lattice import TimeLattice, Tube, Visited


@kernel
def way_back(
    visited: Visited, lattice: TimeLattice, tube: Tube, allowed: Words, begins: Flags, level: int,
    arrival: int,
) -> tuple[int, Ints]:  # fmt: skip
    """The speeds of a law that arrives at a step, as few changes as it takes going back from there.

    Args:
        visited: Of ``earliest_arrivals``, as the next ones.
        lattice: TimeLattice.
        tube: Tube.
        allowed: Words.
        begins: Flags.
        level: int.
        arrival: The step at which it comes to rest at the last place.

    Returns:
        (begin, levels): the step at which it begins, and the levels from there to the arrival,
        (arrival - begin + 1,).
    """
    found = np.empty(arrival + 1, np.int64)
    k, place, n, change = 0, lattice.last, arrival, 0
    found[n] = 0
    while n > 0 and not (begins[n] and k == level and place == 0):
        chosen = k - _change_into(visited, lattice, tube, allowed, n, k, place, change)
        change = k - chosen
        place -= k + chosen
        k = chosen
        n -= 1
        found[n] = k
    return n, found[n:].copy()


@inner
def _change_into(
    visited: Visited, lattice: TimeLattice, tube: Tube, allowed: Words, n: int, k: int,
    place: int, like: int,
) -> int:  # fmt: skip
    """With which change of the speed a state may have been reached; if it can be, like another."""
    best = lattice.ups + 1
    for change in range(-lattice.downs, lattice.ups + 1):
        before = k - change
        if not 0 <= before <= lattice.levels:
            continue
        start = place - k - before
        at = start - 64 * tube.words[n - 1]
        band = visited.bands[n - 1, before]
        if not (start >= 0 and band[0] <= at >> 6 < band[1]):
            continue
        if not has_place(visited.rows[n - 1, before], at):
            continue
        if not has_place(allowed[before, change + lattice.downs], start):
            continue
        if change == like:
            return change
        if best > lattice.ups or abs(change) > abs(best):
            best = change
    return best
