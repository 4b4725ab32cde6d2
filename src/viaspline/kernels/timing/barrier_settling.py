"""A motion with a limit of the jerk that keeps its limits, found from one that doesn't.

The limits that a motion doesn't keep are widened until it does; from the middle of what that allows
they are narrowed again, as far as they are kept there.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inlined, inner, kernel
from viaspline.kernels.timing.barrier_newton import least_from
from viaspline.kernels.timing.speed_barrier import (
    BarrierTerms,
    known,
    of_row,
    square_at,
    time_of,
    value_of,
)

LEAST_SIZE = 1e-6  # what limits are compared with, at least
JERK_WEIGHT = 0.01  # of what is lacking of the jerk, beside what is of other limits

FIRST_ROOM, LEAST_ROOM = 0.05, 1e-6
"""Room that widened limits have at first and later, at least, as a part of the true ones,"""

KEPT_ROOM = 0.3
"""and the part of the room before that is kept."""

LEAST_GAIN, MAX_LOST = 0.9, 8
"""A round is lost if it lacks more than this part of the best; after so many it is over."""

CENTRE_SHARPNESS = 2e-3
"""How sharp the barrier is in the middle, times what is asked over the time."""


@inlined
def _size(limit: float) -> float:
    """What a limit is compared with."""
    return max(abs(limit), LEAST_SIZE)


@inner
def _spent(terms: BarrierTerms, m: Floats, i: int) -> float:
    """The largest jerk on a stretch [m/s³]; nan if v² is below 0 there."""
    x, y, z = known(terms, m, i, 0), known(terms, m, i, 1), known(terms, m, i, 2)
    steep, largest = abs(of_row(terms.change, i, x, y, z)), 0.0
    for j in range(3):
        square = square_at(terms.squares, i, j, x, y, z)
        if square < 0.0:
            return math.nan
        largest = max(largest, steep * math.sqrt(square))
    return largest


@inner
def _lack(terms: BarrierTerms, m: Floats) -> float:
    """By what parts of them limits are not kept, in all; nan if v² is below 0 somewhere."""
    off, harsh = 0.0, 0.0
    for i in range(m.shape[0]):
        x, y, z = known(terms, m, i, 0), known(terms, m, i, 1), known(terms, m, i, 2)
        for k in range(terms.first[i], terms.first[i + 1]):
            limit = terms.limits[k]
            off += max(of_row(terms.rows, k, x, y, z) - limit, 0.0) / _size(limit)
        steep = abs(of_row(terms.change, i, x, y, z))
        for j in range(3):
            square = square_at(terms.squares, i, j, x, y, z)
            if square < 0.0:
                return math.nan
            harsh += max(steep * math.sqrt(square) - terms.jerk[i], 0.0) / terms.jerk[i]
    return off + JERK_WEIGHT * harsh


@inner
def _narrow(
    true: BarrierTerms, m: Floats, kept: float, least: float, limits: Floats, jerk: Floats
) -> None:
    """Bring widened limits and jerks nearer to the true ones, in place, as far as they are kept."""
    for i in range(m.shape[0]):
        x, y, z = known(true, m, i, 0), known(true, m, i, 1), known(true, m, i, 2)
        for k in range(true.first[i], true.first[i + 1]):
            used = of_row(true.rows, k, x, y, z)
            room = max(kept * (limits[k] - used), least * _size(true.limits[k]))
            limits[k] = max(true.limits[k], used + room)
        spent = _spent(true, m, i)
        room = max(kept * (jerk[i] - spent), least * true.jerk[i])
        jerk[i] = max(true.jerk[i], spent + room)


@kernel
def barrier_lack(terms: BarrierTerms, m: Floats) -> float:
    """By what parts of them limits are not kept, in all; those of the jerk count for little.

    Args:
        terms: What is asked.
        m: Coefficients [m²/s²], above 0, shape (n,).

    Returns:
        0 if all are kept; nan if v² is below 0 somewhere.
    """
    return _lack(terms, m)


@kernel
def barrier_settled(
    terms: BarrierTerms, m: Floats, rounds: int, steps: int
) -> tuple[Floats, Floats, Floats]:
    """Coefficients that keep every limit strictly, or as nearly as is found.

    Args:
        terms: What is asked.
        m: Coefficients to begin with [m²/s²], above 0, shape (n,).
        rounds: In which limits are narrowed, at most,
        steps: and Newton's steps in each.

    Returns:
        The limits, shape (r,), and the jerks [m/s³], shape (n,), widened where they have to be, and
        coefficients that keep them strictly, shape (n,).
    """
    limits, jerk = terms.limits.copy(), terms.jerk.copy()
    best_limits, best_jerk, best = limits.copy(), jerk.copy(), m
    wide = BarrierTerms(
        terms.widths, terms.near, terms.before, jerk, terms.squares, terms.change, terms.rows,
        limits, terms.first, terms.gauss, terms.rests, terms.places, terms.order, terms.bands,
    )  # fmt: skip
    asked = 6.0 * m.shape[0] + limits.shape[0]
    least, lost = np.inf, 0
    for k in range(rounds):
        off = _lack(terms, m)
        if off == 0.0 and value_of(terms, m, 1.0) < np.inf:
            return terms.limits.copy(), terms.jerk.copy(), m
        if not off < np.inf:
            break
        if k == 0:
            _narrow(terms, m, 0.0, FIRST_ROOM, limits, jerk)
        else:
            _narrow(terms, m, KEPT_ROOM, LEAST_ROOM, limits, jerk)
        lost = 0 if off < LEAST_GAIN * least else lost + 1
        if off < least:
            least, best = off, m
            best_limits[:] = limits
            best_jerk[:] = jerk
        if lost > MAX_LOST:
            break
        m = least_from(wide, m, CENTRE_SHARPNESS * asked / time_of(terms, m), steps)
    return best_limits, best_jerk, best
