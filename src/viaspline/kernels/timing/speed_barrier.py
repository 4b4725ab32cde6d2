"""The barrier of the fastest v² with a limit of the jerk, and its derivatives.

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

LEAST_PRODUCT, MOST_PRODUCT = 1e-150, 1e150  # of what is left, before its logarithm is taken


Sums = tuple[float, float, float, float, float, float, float, float, float]
"""Of a stretch: a gradient by its three coefficients, and half of the second derivative."""


class BarrierTerms(NamedTuple):
    """What is asked of n stretches; rows stand for linear functions of the three coefficients.

    Attributes:
        widths: [m], shape (n,).
        near: Which coefficients a stretch knows, shape (n, 3): n is ``before``, n + 1 is none.
        before: The coefficient of the stretch before all of these [m²/s²].
        jerk: Limits of it [m/s³], shape (n,).
        squares: v² at the start, in the middle and at the end, shape (n, 3, 3).
        change: da/ds, shape (n, 3).
        rows: What is limited, those of each stretch behind each other, shape (r, 3).
        limits: By how much, shape (r,).
        first: The first row of every stretch, and how many there are, shape (n + 1,).
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
    first: Ints
    gauss: Floats
    rests: Floats
    places: Ints
    order: Ints
    bands: int


@inlined
def known(terms: BarrierTerms, m: Floats, i: int, c: int) -> float:
    """One of the three coefficients that a stretch knows."""
    k, n = terms.near[i, c], m.shape[0]
    return m[k] if k < n else (terms.before if k == n else 0.0)


@inlined
def of_row(rows: Floats, k: int, x: float, y: float, z: float) -> float:
    """A row with the three coefficients."""
    return rows[k, 0] * x + rows[k, 1] * y + rows[k, 2] * z


@inlined
def square_at(rows: Floats, i: int, j: int, x: float, y: float, z: float) -> float:
    """v² at one of several places of a stretch, by the three coefficients."""
    return rows[i, j, 0] * x + rows[i, j, 1] * y + rows[i, j, 2] * z


@inlined
def _with_room(logs: float, left: float, room: float) -> tuple[float, float]:
    """Logarithms, and a product whose own is still to be taken: each takes as long as five rows."""
    left *= room
    if LEAST_PRODUCT < left < MOST_PRODUCT:
        return logs, left
    return logs + math.log(left), 1.0


@inner
def value_of(terms: BarrierTerms, m: Floats, sharpness: float) -> float:
    """What the barrier makes least; inf where a limit isn't kept strictly."""
    time, logs, left = 0.0, 0.0, 1.0
    for i in range(m.shape[0]):
        if not m[i] > 0.0:
            return np.inf
        x, y, z = known(terms, m, i, 0), known(terms, m, i, 1), known(terms, m, i, 2)
        for k in range(terms.first[i], terms.first[i + 1]):
            room = terms.limits[k] - of_row(terms.rows, k, x, y, z)
            if not room > 0.0:
                return np.inf
            logs, left = _with_room(logs, left, room)
        steep = of_row(terms.change, i, x, y, z)
        for j in range(3):
            square = square_at(terms.squares, i, j, x, y, z)
            room = terms.jerk[i] * terms.jerk[i] - steep * steep * square
            if not (square >= 0.0 and room > 0.0):
                return np.inf
            logs, left = _with_room(logs, left, room)
        for j in range(2):
            square = square_at(terms.gauss, i, j, x, y, z)
            if not square > 0.0:
                return np.inf
            time += 0.5 * terms.widths[i] / math.sqrt(square)
    for r in range(terms.rests.shape[0]):
        time += terms.rests[r, 1] / math.sqrt(m[int(terms.rests[r, 0])])
    return sharpness * time - logs - math.log(left)


@inlined
def _curved(x: float, y: float, z: float, first: float, second: float, sums: Sums) -> Sums:
    """Sums with the derivatives of a function of a row: first · row and second · row rowᵀ."""
    a, b, c, aa, ba, bb, ca, cb, cc = sums
    p, q, r = second * x, second * y, second * z
    a, b, c = a + first * x, b + first * y, c + first * z
    return a, b, c, aa + p * x, ba + p * y, bb + q * y, ca + r * x, cb + r * y, cc + r * z


@inner
def derivatives(
    terms: BarrierTerms, m: Floats, sharpness: float, gradient: Floats, bands: Floats
) -> None:
    """Gradient (n,) and a positive definite second derivative, in lower bands laid flat."""
    n = m.shape[0]
    rows, squares, change, gauss = terms.rows, terms.squares, terms.change, terms.gauss
    near, places = terms.near, terms.places
    gradient.fill(0.0)
    bands.fill(0.0)
    for i in range(n):
        x, y, z = known(terms, m, i, 0), known(terms, m, i, 1), known(terms, m, i, 2)
        sums = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        for k in range(terms.first[i], terms.first[i + 1]):
            push = 1.0 / (terms.limits[k] - of_row(rows, k, x, y, z))
            sums = _curved(rows[k, 0], rows[k, 1], rows[k, 2], push, push * push, sums)
        steep, most = of_row(change, i, x, y, z), terms.jerk[i]
        for j in range(3):
            root = math.sqrt(square_at(squares, i, j, x, y, z))
            tilt = 0.5 * steep / root
            under, above = 1.0 / (most - steep * root), 1.0 / (most + steep * root)
            p = root * change[i, 0] + tilt * squares[i, j, 0]
            q = root * change[i, 1] + tilt * squares[i, j, 1]
            r = root * change[i, 2] + tilt * squares[i, j, 2]
            sums = _curved(p, q, r, under - above, under * under + above * above, sums)
        for j in range(2):
            square = square_at(gauss, i, j, x, y, z)
            push = 0.25 * sharpness * terms.widths[i] / (square * math.sqrt(square))
            p, q, r = gauss[i, j, 0], gauss[i, j, 1], gauss[i, j, 2]
            sums = _curved(p, q, r, -push, 1.5 * push / square, sums)
        a, b, c, aa, ba, bb, ca, cb, cc = sums
        for k in range(terms.rests.shape[0]):
            if int(terms.rests[k, 0]) == i:
                rest = sharpness * terms.rests[k, 1] / (m[i] * math.sqrt(m[i]))
                b -= 0.5 * rest
                bb += 0.75 * rest / m[i]
        gradient[i] += b
        if near[i, 0] < n:
            gradient[near[i, 0]] += a
        if near[i, 2] < n:
            gradient[near[i, 2]] += c
        bands[places[i, 0, 0]] += aa
        bands[places[i, 1, 1]] += bb
        bands[places[i, 2, 2]] += cc
        for k, l, both in ((0, 1, ba), (0, 2, ca), (1, 2, cb)):
            bands[places[i, k, l]] += both
            bands[places[i, l, k]] += both


@inner
def time_of(terms: BarrierTerms, m: Floats) -> float:
    """How long a motion takes, but for what lies before a start at a speed [s]."""
    time = 0.0
    for i in range(m.shape[0]):
        x, y, z = known(terms, m, i, 0), known(terms, m, i, 1), known(terms, m, i, 2)
        for j in range(2):
            time += 0.5 * terms.widths[i] / math.sqrt(square_at(terms.gauss, i, j, x, y, z))
    for r in range(terms.rests.shape[0]):
        time += terms.rests[r, 1] / math.sqrt(m[int(terms.rests[r, 0])])
    return time


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
    return value_of(terms, m, sharpness)


@kernel
def motion_time(terms: BarrierTerms, m: Floats) -> float:
    """How long a motion takes, but for what lies before a start at a speed [s].

    Args:
        terms: What is asked.
        m: Coefficients [m²/s²], above 0, shape (n,).

    Returns:
        nan or inf where the robot doesn't get on.
    """
    return time_of(terms, m)
