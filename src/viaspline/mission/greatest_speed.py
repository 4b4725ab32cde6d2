"""Does anything go or turn faster than anything does, from one keyframe to the next?

A bound of the clearance takes strides in time that are the shorter the faster things are, so what
goes as fast as nothing does would be looked at for ever.

Tested through ``mission/test_motion``.
"""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Floats

MAX_JUMP_MPS = 1e6
"""Nothing goes from one keyframe to the next faster than this [m/s]; a jump may take 1 ms."""

MAX_TURN_DPS = 1e6
"""Nothing turns faster than this [deg/s]."""

TooFast = tuple[int, str, str]
"""The keyframe at which it is there too soon, what is wrong with it, and the remedy."""


def gone_too_fast(times: Floats, places: Floats) -> TooFast | None:
    """The first keyframe that is too far from the one before; None if none is.

    Args:
        times: Increasing [s], (n,).
        places: [m], (n, d).

    >>> gone_too_fast(np.array([0.0, 1.0, 1.00001]), np.array([[0.0], [5.0], [25.0]]))[:2]
    (2, 'is 20 m from the one before, 1e-05 s later: it goes 2e+06 m/s')
    """
    far = np.sqrt((np.diff(places, axis=0) ** 2).sum(axis=1))
    spans = np.diff(times)
    fast = np.flatnonzero(far > MAX_JUMP_MPS * spans)
    if not fast.size:
        return None
    i, most = int(fast[0]), MAX_JUMP_MPS
    problem = f"is {far[i]:g} m from the one before, {spans[i]:g} s later: it goes "
    least = f"give it {1.01 * far[i] / most:.2g} s for that at least, or leave one out"
    return i + 1, f"{problem}{far[i] / spans[i]:g} m/s", f"nothing goes over {most:g} m/s; {least}"


def turned_too_fast(times: Floats, headings: Floats) -> TooFast | None:
    """The first keyframe that is turned too far from the one before; None if none is.

    Args:
        times: Increasing [s], (n,).
        headings: [deg], (n,).

    >>> turned_too_fast(np.array([0.0, 1.0, 1.00001]), np.array([0.0, 0.0, 90.0]))[:2]
    (2, 'is turned by 90 deg from the one before, 1e-05 s later')
    """
    turned, spans = np.abs(np.diff(headings)), np.diff(times)
    quick = np.flatnonzero(turned > MAX_TURN_DPS * spans)
    if not quick.size:
        return None
    i = int(quick[0])
    problem = f"is turned by {turned[i]:g} deg from the one before, {spans[i]:g} s later"
    least = f"give it {1.01 * turned[i] / MAX_TURN_DPS:.2g} s for that at least"
    return i + 1, problem, f"nothing turns by more than {MAX_TURN_DPS:g} deg/s; {least}"
