"""The barrier of the fastest v² with a limit of the jerk, and Newton's method for it.

What is sought are coefficients of v² on the stretches of a path: a stretch knows its own, the one
before it and the one after it, and all that is asked of it is a function of these three. So the
second derivative is a narrow band.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inlined, inner, kernel

LEAST_DROP = 1e-8  # of the barrier in a step that is worth it, as a part of 1 + its value
LEAST_PART = 1e-8  # of a step
KEPT_DROP = 0.1  # part of what a step promises that it has to keep
REGULAR = 1e-14  # part of every entry of a matrix's diagonal that is added to it


class BarrierTerms(NamedTuple):
    """What is asked of n stretches; rows stand for linear functions of the three coefficients.

    Attributes:
        widths: [m], shape (n,).
        near: Which coefficients a stretch knows, shape (n, 3): n is ``before``, n + 1 is none.
        before: The coefficient of the stretch before all of these [m²/s²].
        jerk: Limits of it [m/s³], shape (n,).
        squares: v² at the start, in the middle and at the end, shape (n, 3, 3).
        change: da/ds, shape (n, 1, 3).
        rows: What is limited, shape (n, k, 3).
        limits: By how much, shape (n, k); inf where a row is empty.
        gauss: v² at two places of every stretch, shape (n, 2, 3).
        rests: Of stretches beside a rest: the one that moves next to it, and the weight of its
            coefficient in the time, 3 h / sqrt(share), shape (r, 2).
        places: Where products of what a stretch knows go in the bands, laid flat, shape (n, 3, 3);
            the last place is for none.
        order: Place of every coefficient in the matrix, shape (n,).
        bands: How many there are.
    """

    widths: Floats
    near: Ints
    before: float
    jerk: Floats
    squares: Floats
    change: Floats
    rows: Floats
    limits: Floats
    gauss: Floats
    rests: Floats
    places: Ints
    order: Ints
    bands: int


@inlined
def _dot(rows: Floats, i: int, k: int, known: Floats) -> float:
    """A row of a stretch with what it knows."""
    return rows[i, k, 0] * known[0] + rows[i, k, 1] * known[1] + rows[i, k, 2] * known[2]


@inner
def _known(terms: BarrierTerms, m: Floats, i: int, known: Floats) -> None:
    """The three coefficients that a stretch knows."""
    n = m.shape[0]
    for c in range(3):
        k = terms.near[i, c]
        known[c] = m[k] if k < n else (terms.before if k == n else 0.0)


@inner
def _value(terms: BarrierTerms, m: Floats, sharpness: float) -> float:
    """What the barrier makes least; inf where a limit isn't kept strictly."""
    known, time, logs = np.empty(3), 0.0, 0.0
    for i in range(m.shape[0]):
        if not m[i] > 0.0:
            return np.inf
        _known(terms, m, i, known)
        for k in range(terms.limits.shape[1]):
            if terms.limits[i, k] < np.inf:
                slack = terms.limits[i, k] - _dot(terms.rows, i, k, known)
                if not slack > 0.0:
                    return np.inf
                logs += math.log(slack)
        steep = _dot(terms.change, i, 0, known)
        for j in range(3):
            square = _dot(terms.squares, i, j, known)
            room = terms.jerk[i] * terms.jerk[i] - steep * steep * square
            if not (square >= 0.0 and room > 0.0):
                return np.inf
            logs += math.log(room)
        for j in range(2):
            square = _dot(terms.gauss, i, j, known)
            if not square > 0.0:
                return np.inf
            time += 0.5 * terms.widths[i] / math.sqrt(square)
    for r in range(terms.rests.shape[0]):
        time += terms.rests[r, 1] / math.sqrt(m[int(terms.rests[r, 0])])
    return sharpness * time - logs


@inlined
def _curve(
    rows: Floats, i: int, k: int, first: float, second: float, slope: Floats, local: Floats
) -> None:  # fmt: skip
    """Add the derivatives of a function of a row: first · row and second · row rowᵀ."""
    for c in range(3):
        slope[c] += first * rows[i, k, c]
        for d in range(c + 1):
            local[c, d] += second * rows[i, k, c] * rows[i, k, d]


@inner
def _derivatives(
    terms: BarrierTerms, m: Floats, sharpness: float, gradient: Floats, bands: Floats
) -> None:
    """Gradient (n,) and a positive definite second derivative, in lower bands laid flat."""
    n = m.shape[0]
    known, slope, local, tilt = np.empty(3), np.empty(3), np.empty((3, 3)), np.empty((1, 1, 3))
    gradient.fill(0.0)
    bands.fill(0.0)
    for i in range(n):
        _known(terms, m, i, known)
        slope.fill(0.0)
        local.fill(0.0)
        for k in range(terms.limits.shape[1]):
            if terms.limits[i, k] < np.inf:
                slack = terms.limits[i, k] - _dot(terms.rows, i, k, known)
                _curve(terms.rows, i, k, 1.0 / slack, 1.0 / (slack * slack), slope, local)
        steep = _dot(terms.change, i, 0, known)
        for j in range(3):
            root = math.sqrt(_dot(terms.squares, i, j, known))
            for c in range(3):
                tilt[0, 0, c] = root * terms.change[i, 0, c]
                tilt[0, 0, c] += 0.5 * steep / root * terms.squares[i, j, c]
            under, above = terms.jerk[i] - steep * root, terms.jerk[i] + steep * root
            first = 1.0 / under - 1.0 / above
            second = 1.0 / (under * under) + 1.0 / (above * above)
            _curve(tilt, 0, 0, first, second, slope, local)
        for j in range(2):
            square = _dot(terms.gauss, i, j, known)
            push = 0.25 * sharpness * terms.widths[i] / (square * math.sqrt(square))
            _curve(terms.gauss, i, j, -push, 1.5 * push / square, slope, local)
        for r in range(terms.rests.shape[0]):
            if int(terms.rests[r, 0]) == i:
                rest = sharpness * terms.rests[r, 1] / (m[i] * math.sqrt(m[i]))
                slope[1] -= 0.5 * rest
                local[1, 1] += 0.75 * rest / m[i]
        for c in range(3):
            if terms.near[i, c] < n:
                gradient[terms.near[i, c]] += slope[c]
            for d in range(3):
                bands[terms.places[i, c, d]] += local[max(c, d), min(c, d)]


@inner
def _solved(bands: Floats, count: int, n: int, right: Floats) -> bool:
    """Solve for a right-hand side in place, by Cholesky; False if the matrix isn't definite."""
    for j in range(n):
        if not bands[j] > 0.0:
            return False
        bands[j] = math.sqrt(bands[j])
        last = min(count - 1, n - 1 - j)
        for k in range(1, last + 1):
            bands[k * n + j] /= bands[j]
        for k in range(1, last + 1):
            for i in range(k, last + 1):
                bands[(i - k) * n + j + k] -= bands[i * n + j] * bands[k * n + j]
    for j in range(n):
        for k in range(1, min(count - 1, j) + 1):
            right[j] -= bands[k * n + j - k] * right[j - k]
        right[j] /= bands[j]
    for j in range(n - 1, -1, -1):
        for k in range(1, min(count - 1, n - 1 - j) + 1):
            right[j] -= bands[k * n + j] * right[j + k]
        right[j] /= bands[j]
    return True


@kernel
def barrier_value(terms: BarrierTerms, m: Floats, sharpness: float) -> float:
    """What the barrier makes least: sharpness · time - the logarithms of all that is left.

    Args:
        terms: What is asked.
        m: Coefficients [m²/s²], shape (n,).
        sharpness: Of the barrier.

    Returns:
        inf where a limit isn't kept strictly.
    """
    return _value(terms, m, sharpness)


@kernel
def barrier_least(terms: BarrierTerms, m: Floats, sharpness: float, rounds: int) -> Floats:
    """The least of the barrier, from coefficients on that keep every limit strictly.

    Args:
        terms: What is asked.
        m: Coefficients to begin with [m²/s²], shape (n,).
        sharpness: Of the barrier.
        rounds: Newton's steps, at most.

    Returns:
        The coefficients, (n,).
    """
    n = m.shape[0]
    m, new = m.copy(), np.empty(n)
    gradient, right, step = np.empty(n), np.empty(n), np.empty(n)
    bands = np.empty(terms.bands * n + 1)
    value = _value(terms, m, sharpness)
    for _ in range(rounds):
        _derivatives(terms, m, sharpness, gradient, bands)
        for i in range(n):
            right[terms.order[i]] = gradient[i]
            bands[i] += REGULAR * bands[i]  # beside a cusp they are 1e20 times those elsewhere
        if not _solved(bands, terms.bands, n, right):
            break
        drop = 0.0
        for i in range(n):
            step[i] = -right[terms.order[i]]
            drop += gradient[i] * step[i]
        if not drop <= -LEAST_DROP * (1.0 + abs(value)):
            break
        part, least = 1.0, np.inf
        while part > LEAST_PART:
            for i in range(n):
                new[i] = m[i] + part * step[i]
            least = _value(terms, new, sharpness)
            if least <= value + KEPT_DROP * part * drop:
                break
            part *= 0.5
        if part <= LEAST_PART:
            break
        m, new, value = new, m, least
    return m
