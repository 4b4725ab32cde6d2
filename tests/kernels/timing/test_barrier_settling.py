"""Motions that are brought to keep their limits, against numpy's sums of what they lack."""

from __future__ import annotations

import numpy as np
from barrier_terms import numpy_value, random_terms, seeds
from hypothesis import given, settings
from hypothesis import strategies as st

from viaspline.kernels.timing.barrier_settling import barrier_lack, barrier_settled
from viaspline.kernels.timing.speed_barrier import BarrierTerms

ROUNDS, STEPS = 40, 8


def numpy_lack(terms: BarrierTerms, m: np.ndarray) -> float:
    known = np.append(m, (terms.before, 0.0))[terms.near]
    each = known.repeat(np.diff(terms.first), axis=0)
    used = np.einsum("rc,rc->r", terms.rows, each)
    off = (np.maximum(used - terms.limits, 0.0) / np.maximum(np.abs(terms.limits), 1e-6)).sum()
    squares = np.einsum("nkc,nc->nk", terms.squares, known)
    jerk = np.abs(np.einsum("nc,nc->n", terms.change, known))[:, None] * np.sqrt(squares)
    return float(off + 0.01 * (np.maximum(jerk / terms.jerk[:, None] - 1.0, 0.0)).sum())


@given(seeds, st.floats(0.1, 30.0))
@settings(deadline=None, max_examples=60)
def test_what_is_lacking_is_the_sum_of_its_parts(seed: int, factor: float) -> None:
    terms, m = random_terms(seed)
    assert np.isclose(barrier_lack(terms, factor * m), numpy_lack(terms, factor * m), rtol=1e-9)


@given(seeds)
@settings(deadline=None, max_examples=40)
def test_a_motion_that_keeps_its_limits_stays_as_it_is(seed: int) -> None:
    terms, m = random_terms(seed)
    limits, jerk, found = barrier_settled(terms, m, ROUNDS, STEPS)
    assert (limits == terms.limits).all()
    assert (jerk == terms.jerk).all()
    assert (found == m).all()


@given(seeds, st.floats(1.0, 30.0))
@settings(deadline=None, max_examples=60)
def test_limits_are_widened_alone_and_then_kept_and_no_more_is_lacking(
    seed: int, factor: float
) -> None:
    terms, m = random_terms(seed)
    limits, jerk, found = barrier_settled(terms, factor * m, ROUNDS, STEPS)
    assert (limits >= terms.limits).all()
    assert (jerk >= terms.jerk).all()
    assert numpy_value(terms._replace(limits=limits, jerk=jerk), found, 1.0) < np.inf
    assert numpy_lack(terms, found) <= numpy_lack(terms, factor * m) * (1.0 + 1e-12)


@given(seeds, st.floats(1.0, 30.0))
@settings(deadline=None, max_examples=60)
def test_where_there_is_a_motion_near_one_that_keeps_every_limit_is_found(
    seed: int, factor: float
) -> None:
    """Without a limit of the jerk the problem is convex, and the terms' own motion is one."""
    terms, m = random_terms(seed)
    free = terms._replace(jerk=np.full(len(m), 1e6))
    _, _, found = barrier_settled(free, factor * m, ROUNDS, STEPS)
    assert numpy_lack(free, found) == 0.0
