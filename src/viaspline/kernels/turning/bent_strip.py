"""The offsets from a row of places at which a path bends least, between bounds.

A thin strip under tension: its bending is priced against its length. What is sharper than asked for
may be dearer, by the fourth power of its curvature: where a strip touches a corner its curvature is
pointed, and a robot that slows down for it is sooner round a blunter one. Where no bound is
met one system of five diagonals tells; else bounds are kept by an interior point method, of which
every step is such a system.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.jit import inner, kernel, uncounted

MAX_ROUNDS = 30
CENTERED = 0.15  # what the product of slack and price is brought down to in a round
TO_BOUND = 0.95  # of the way to the first bound that is met
SETTLED = 1e-5  # product of slack and price over the cost of a place
FIRST_PRODUCT = 0.1  # the same, at first
LEAST_SLACK = 1e-3  # of the room between bounds, at first
SHORTENED = 0.6  # of a turn [rad] that a step counts for by which it is shortened, as a share of it
SHARP_PRICE = (
    3.0  # of bending, for each time that the square of a curvature is beyond what is sharp
)


@inner
def _wrapped(angle: float) -> float:
    return angle - 2.0 * math.pi * math.floor((angle + math.pi) / (2.0 * math.pi))


@inner
def _turn_price(turn: float, share: float, sharp: float) -> tuple[float, float]:
    """How the cost of a turn [rad] over a share of the way [m] grows with it, and how that does.

    Beyond the curvature that is sharp its square is priced by how far it is beyond, once more.
    """
    over = SHARP_PRICE * max((turn / (share * sharp)) ** 2 - 1.0, 0.0)
    each = 2.0 / share
    slope = each * (1.0 + over) * turn
    return slope, each * (1.0 + 3.0 * over + (2.0 * SHARP_PRICE if over > 0.0 else 0.0))


@uncounted
def _bands(
    places: Floats, normals: Floats, closed: bool, tension: float, sharp: float, bands: Floats,
    slopes: Floats, seam: Floats,
) -> float:  # fmt: skip
    """The cost of a polyline to the second order in offsets of its places along normals.

    Args:
        places: [m], (n, 2).
        normals: Unit vectors, (n, 2).
        closed: Whether it is a round, whose last place is its first.
        tension: What a metre of length is priced at [1/m²].
        sharp: Curvature beyond which bending is dearer [1/m].
        bands: The diagonal and the two beside it, (n, 3); filled.
        slopes: (n,); filled.
        seam: Of a round: how its turn there changes by offsets, times the root of its weight, of
            the second place and of the last but one; that is no part of the bands, (2,); filled.

    Returns:
        The bending [1/m].
    """
    count = places.shape[0]
    bands[:] = 0.0
    slopes[:] = 0.0
    seam[:] = 0.0
    bending, heading, length = 0.0, 0.0, 0.0
    back, ahead = 0.0, 0.0  # of the heading of the piece before, by the offsets of its ends
    for j in range(count - 1):
        dx, dy = places[j + 1, 0] - places[j, 0], places[j + 1, 1] - places[j, 1]
        long = math.hypot(dx, dy)
        c, s = dx / long, dy / long
        here = math.atan2(dy, dx)
        b = -(c * normals[j, 1] - s * normals[j, 0]) / long
        a = (c * normals[j + 1, 1] - s * normals[j + 1, 0]) / long
        slopes[j] -= tension * (c * normals[j, 0] + s * normals[j, 1])
        slopes[j + 1] += tension * (c * normals[j + 1, 0] + s * normals[j + 1, 1])
        bands[j, 0] += tension * long * b * b
        bands[j, 1] += tension * long * a * b
        bands[j + 1, 0] += tension * long * a * a
        if j > 0:
            turn = _wrapped(here - heading)
            share = 0.5 * (length + long)
            first, middle, last = -back, b - ahead, a
            slope, each = _turn_price(turn, share, sharp)
            bending += turn * turn / share
            slopes[j - 1] += slope * first
            slopes[j] += slope * middle
            slopes[j + 1] += slope * last
            bands[j - 1, 0] += each * first * first
            bands[j - 1, 1] += each * first * middle
            bands[j - 1, 2] += each * first * last
            bands[j, 0] += each * middle * middle
            bands[j, 1] += each * middle * last
            bands[j + 1, 0] += each * last * last
        elif closed:
            bending += _seam(places, normals, sharp, here, long, a, slopes, seam)
        heading, length, back, ahead = here, long, b, a
    return bending


@uncounted
def _seam(
    places: Floats, normals: Floats, sharp: float, heading: float, step: float, per: float,
    slopes: Floats, seam: Floats,
) -> float:  # fmt: skip
    """The cost of the turn at the seam of a round, by the places beside it; its bending."""
    j = places.shape[0] - 2
    dx, dy = places[j + 1, 0] - places[j, 0], places[j + 1, 1] - places[j, 1]
    long = math.hypot(dx, dy)
    turn = _wrapped(heading - math.atan2(dy, dx))
    before = (dx * normals[j, 1] - dy * normals[j, 0]) / (long * long)
    share = 0.5 * (step + long)
    slope, each = _turn_price(turn, share, sharp)
    slopes[1] += slope * per
    slopes[j] += slope * before
    seam[0], seam[1] = math.sqrt(each) * per, math.sqrt(each) * before
    return turn * turn / share


@uncounted
def _factor(bands: Floats, more: Floats, fixed: Flags, work: Floats) -> None:
    """Factor a symmetric matrix of five diagonals, with more on the main one, into ``work``.

    What one row hands to the next is held outside of arrays, here and below: it is sooner at hand.
    """
    count = more.shape[0]
    d1, e1, f1, d2, f2 = 1.0, 0.0, 0.0, 1.0, 0.0  # of the row before, of the one before that
    for j in range(count):
        d, e, f = bands[j, 0] + more[j], bands[j, 1], bands[j, 2]
        if fixed[j]:
            d, e, f = 1.0, 0.0, 0.0
        if j + 1 < count and fixed[j + 1]:
            e = 0.0
        if j + 2 < count and fixed[j + 2]:
            f = 0.0
        if j > 0:
            d -= e1**2 * d1
            e -= e1 * f1 * d1
        if j > 1:
            d -= f2**2 * d2
        d2, f2 = d1, f1
        d1, e1, f1 = d, e / d, f / d
        work[j, 0], work[j, 1], work[j, 2] = d1, e1, f1


@uncounted
def _solve(work: Floats, fixed: Flags, right: Floats) -> None:
    """Solve the system whose matrix is factored in ``work``, in place of right."""
    count = right.shape[0]
    one, two = 0.0, 0.0
    for j in range(count):
        here = 0.0 if fixed[j] else right[j]
        if j > 0:
            here -= work[j - 1, 1] * one
        if j > 1:
            here -= work[j - 2, 2] * two
        right[j] = here
        one, two = here, one
    for j in range(count - 1, -1, -1):
        here = right[j] / work[j, 0]
        if j + 1 < count:
            here -= work[j, 1] * one
        if j + 2 < count:
            here -= work[j, 2] * two
        right[j] = here
        one, two = here, one


@uncounted
def _solve_both(work: Floats, fixed: Flags, right: Floats, other: Floats) -> None:
    """As ``_solve``, for two right sides: side by side they take hardly longer than one."""
    count = right.shape[0]
    one, two, other_one, other_two = 0.0, 0.0, 0.0, 0.0
    for j in range(count):
        here, its = (0.0, 0.0) if fixed[j] else (right[j], other[j])
        if j > 0:
            here -= work[j - 1, 1] * one
            its -= work[j - 1, 1] * other_one
        if j > 1:
            here -= work[j - 2, 2] * two
            its -= work[j - 2, 2] * other_two
        right[j], other[j] = here, its
        one, two, other_one, other_two = here, one, its, other_one
    for j in range(count - 1, -1, -1):
        here, its = right[j] / work[j, 0], other[j] / work[j, 0]
        if j + 1 < count:
            here -= work[j, 1] * one
            its -= work[j, 1] * other_one
        if j + 2 < count:
            here -= work[j, 2] * two
            its -= work[j, 2] * other_two
        right[j], other[j] = here, its
        one, two, other_one, other_two = here, one, its, other_one


@uncounted
def _solve_round(
    bands: Floats, more: Floats, fixed: Flags, seam: Floats, right: Floats, across: Floats,
    work: Floats,
) -> None:  # fmt: skip
    """Solve it with what the seam of a round adds, by the formula of Sherman and Morrison."""
    _factor(bands, more, fixed, work)
    if seam[0] == 0.0 and seam[1] == 0.0:
        _solve(work, fixed, right)
        return
    last = right.size - 2
    across[:] = 0.0
    across[1], across[last] = seam[0], seam[1]
    _solve_both(work, fixed, right, across)
    far = seam[0] * right[1] + seam[1] * right[last]
    far /= 1.0 + seam[0] * across[1] + seam[1] * across[last]
    for j in range(right.size):
        right[j] -= far * across[j]


@uncounted
def _slopes_at(
    bands: Floats, slopes: Floats, seam: Floats, moved: Floats, step: Floats
) -> None:  # fmt: skip
    """By how much less moving on would cost, for each place, into ``step``."""
    count = moved.size
    turned = seam[0] * moved[1] + seam[1] * moved[count - 2]
    for j in range(count):
        step[j] = -slopes[j] - bands[j, 0] * moved[j]
        if j > 0:
            step[j] -= bands[j - 1, 1] * moved[j - 1]
        if j > 1:
            step[j] -= bands[j - 2, 2] * moved[j - 2]
        if j + 1 < count:
            step[j] -= bands[j, 1] * moved[j + 1]
        if j + 2 < count:
            step[j] -= bands[j, 2] * moved[j + 2]
    step[1] -= seam[0] * turned
    step[count - 2] -= seam[1] * turned


@uncounted
def _is_free(
    bands: Floats, slopes: Floats, fixed: Flags, seam: Floats, lower: Floats, upper: Floats,
    moved: Floats, more: Floats, across: Floats, work: Floats,
) -> bool:  # fmt: skip
    """Whether no bound is met where it costs least without any: into ``moved`` then, else zeros."""
    for j in range(moved.size):
        moved[j] = -slopes[j]
    _solve_round(bands, more, fixed, seam, moved, across, work)
    is_free = True
    for j in range(moved.size):
        is_free = is_free and (fixed[j] or lower[j] < moved[j] < upper[j])
    if not is_free:
        moved[:] = 0.0
    return is_free


@uncounted
def _most_turned(places: Floats, normals: Floats, moved: Floats) -> float:
    """By how much a step is turned at most [rad], or as much as it is shortened.

    On the inside of a bend places come nearer to each other, the farther they move: beyond its
    middle they would have changed their order.
    """
    turned = 0.0
    for j in range(moved.size - 1):
        dx, dy = places[j + 1, 0] - places[j, 0], places[j + 1, 1] - places[j, 1]
        long = math.hypot(dx, dy)
        along = moved[j] * (normals[j, 0] * dx + normals[j, 1] * dy)
        along -= moved[j + 1] * (normals[j + 1, 0] * dx + normals[j + 1, 1] * dy)
        turned = max(turned, abs(moved[j + 1] - moved[j]) / long, SHORTENED * along / (long * long))
    return turned


@kernel
def bent_strip(
    places: Floats, normals: Floats, lower: Floats, upper: Floats, fixed: Flags, closed: bool,
    tension: float, sharp: float,
) -> tuple[Floats, Floats, float]:  # fmt: skip
    """Move places along their normals, so that the line through them bends less.

    Args:
        places: [m], (n, 2).
        normals: Unit vectors, (n, 2).
        lower: By what they move at least [m], (n,).
        upper: By what they move at most [m], above that, (n,).
        fixed: Which of them stay, the first and the last among them, (n,).
        closed: Whether it is a round, whose last place is its first.
        tension: What a metre of length is priced at [1/m²].
        sharp: Curvature beyond which bending is dearer [1/m]; infinite where all of it costs alike.

    Returns:
        By what they move [m], (n,); the price of each one's bounds, negative where it would go
        further up, (n,); and by how much a step is turned so at most [rad].
    """
    count = places.shape[0]
    bands, slopes, work = np.empty((count, 3)), np.empty(count), np.empty((count, 3))
    seam, across = np.empty(2), np.empty(count)
    bending = _bands(places, normals, closed, tension, sharp, bands, slopes, seam)
    moved, step, more = np.zeros(count), np.empty(count), np.zeros(count)
    low, high = np.zeros(count), np.zeros(count)
    product = FIRST_PRODUCT * max(bending, 1e-12) / count
    least = SETTLED * product
    if _is_free(bands, slopes, fixed, seam, lower, upper, moved, more, across, work):
        return moved, low, _most_turned(places, normals, moved)
    for j in range(count):
        if not fixed[j]:
            slack = LEAST_SLACK * (upper[j] - lower[j])
            moved[j] = min(max(0.0, lower[j] + slack), upper[j] - slack)
            low[j], high[j] = product / (moved[j] - lower[j]), product / (upper[j] - moved[j])
    for _ in range(MAX_ROUNDS):
        product *= CENTERED
        _slopes_at(bands, slopes, seam, moved, step)
        for j in range(count):
            if not fixed[j]:
                below, above = moved[j] - lower[j], upper[j] - moved[j]
                step[j] += product / below - product / above
                more[j] = low[j] / below + high[j] / above
        _solve_round(bands, more, fixed, seam, step, across, work)
        far, priced = 1.0, 1.0
        for j in range(count):
            if not fixed[j]:
                below, above = moved[j] - lower[j], upper[j] - moved[j]
                if step[j] < 0.0:
                    far = min(far, -TO_BOUND * below / step[j])
                else:
                    far = min(far, TO_BOUND * above / max(step[j], 1e-300))
                to_low = product / below - low[j] - low[j] * step[j] / below
                to_high = product / above - high[j] + high[j] * step[j] / above
                if to_low < 0.0:
                    priced = min(priced, -TO_BOUND * low[j] / to_low)
                if to_high < 0.0:
                    priced = min(priced, -TO_BOUND * high[j] / to_high)
        worst = 0.0
        for j in range(count):
            if not fixed[j]:
                below, above = moved[j] - lower[j], upper[j] - moved[j]
                low[j] += priced * (product / below - low[j] - low[j] * step[j] / below)
                high[j] += priced * (product / above - high[j] + high[j] * step[j] / above)
                moved[j] += far * step[j]
                worst = max(worst, low[j] * (moved[j] - lower[j]), high[j] * (upper[j] - moved[j]))
        product = max(worst, least)
        if worst <= least:
            break
    return moved, low - high, _most_turned(places, normals, moved)
