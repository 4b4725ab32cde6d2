"""A round trip through places, made shorter by exchanges: 2-opt and Or-opt with neighbour lists.

An exchange puts a place beside one of its nearest, or it gains nothing (Bentley, "Fast Algorithms
for Geometric Traveling Salesman Problems", 1992): so of all exchanges only few are looked at.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats, Ints
from viaspline.kernels.jit import inner, kernel

LEAST_GAIN_M = 1e-9


@inner
def _gap(xy: Floats, a: int, b: int) -> float:
    """The distance of two places [m]."""
    level = math.hypot(xy[a, 0] - xy[b, 0], xy[a, 1] - xy[b, 1])
    return level if xy.shape[1] == 2 else math.hypot(level, xy[a, 2] - xy[b, 2])


@inner
def _joined(a: int, b: int, last: int) -> bool:
    """Whether two places follow each other whatever happens: the first and the last."""
    return (a == 0 and b == last) or (a == last and b == 0)


@inner
def _reverse(tour: Ints, place: Ints, i: int, j: int) -> None:
    """Turn round what stands from position i to position j, on round the end."""
    n = tour.size
    length = (j - i) % n + 1
    for k in range(length // 2):
        a = (i + k) % n
        b = (j - k) % n
        tour[a], tour[b] = tour[b], tour[a]
        place[tour[a]] = a
        place[tour[b]] = b


@inner
def _exchange(
    xy: Floats, tour: Ints, place: Ints, near: Ints, a: int, step: int, last: int
) -> bool:
    """2-opt: put a place beside one of its nearest, behind it (step 1) or before it (step -1)."""
    n = tour.size
    b = tour[(place[a] + step) % n]
    if _joined(a, b, last):
        return False
    now = _gap(xy, a, b)
    for k in range(near.shape[1]):
        c = near[a, k]
        gain = now - _gap(xy, a, c)
        if gain <= LEAST_GAIN_M:
            return False
        d = tour[(place[c] + step) % n]
        gain += _gap(xy, c, d) - _gap(xy, b, d)
        if c in (a, b) or d == a or gain <= LEAST_GAIN_M or _joined(c, d, last):
            continue
        i, j = (place[b], place[c]) if step > 0 else (place[c], place[b])
        if 2 * ((j - i) % n + 1) <= n:
            _reverse(tour, place, i, j)
        else:
            _reverse(tour, place, (j + 1) % n, (i - 1) % n)
        return True
    return False


@inner
def _move(xy: Floats, tour: Ints, place: Ints, near: Ints, a: int, size: int, last: int) -> bool:
    """Or-opt: put the places from one on beside one of its nearest, either way round."""
    n = tour.size
    i = place[a]
    j = (i + size - 1) % n
    e = tour[j]
    p = tour[(i - 1) % n]
    q = tour[(j + 1) % n]
    if _joined(p, a, last) or _joined(e, q, last):
        return False
    for k in range(size - 1):
        if _joined(tour[(i + k) % n], tour[(i + k + 1) % n], last):
            return False
    now = _gap(xy, p, a) + _gap(xy, e, q)
    now -= _gap(xy, p, q)
    for k in range(near.shape[1]):
        c = near[a, k]
        beside = _gap(xy, a, c)
        if now - beside <= LEAST_GAIN_M:
            return False
        if (place[c] - i) % n < size:
            continue  # it is one of them
        for step in (-1, 1):  # beyond c: the other end comes to stand beside d
            d = tour[(place[c] + step) % n]
            if (place[d] - i) % n < size or _joined(c, d, last):
                continue
            gain = now - beside - _gap(xy, e, d) + _gap(xy, c, d)
            if gain <= LEAST_GAIN_M:
                continue
            # Between the places that c and d have, turned round or not, as a comes beside c.
            before, behind = (d, c) if step < 0 else (c, d)
            if (place[behind] - j) % n <= (i - place[behind]) % n:  # on from here
                end = place[before]
                _reverse(tour, place, i, end)
                start = (end - size + 1) % n
                _reverse(tour, place, i, (start - 1) % n)
            else:
                end = place[behind]
                _reverse(tour, place, end, j)
                start = end
                _reverse(tour, place, (end + size) % n, j)
            if (tour[(start - 1) % n] == c) != (tour[start] == a):
                _reverse(tour, place, start, (start + size - 1) % n)
            return True
    return False


@kernel
def shortened_tour(xy: Floats, start: Ints, near: Ints, most: int) -> Ints:
    """A round trip with no exchange left that makes it shorter.

    Args:
        xy: Places [m], (n, 2) or (n, 3). The first and the last follow each other whatever happens:
            the trip begins at the one and ends at the other.
        start: All places in the order to begin with, (n,): the first one first, the last one last.
        near: Of each place the nearest, nearest first, (n, k); itself may be among them.
        most: Exchanges beyond which the rest is left.

    Returns:
        The places in a shorter order, (n,), from the first to the last.
    """
    n = start.size
    last = n - 1
    tour = start.copy()
    place = np.empty(n, np.int64)
    for i in range(n):
        place[tour[i]] = i
    done = 0
    changed = True
    while changed and done < most:
        changed = False
        for a in range(n):
            more = True
            while more and done < most:
                more = _exchange(xy, tour, place, near, a, 1, last)
                more = more or _exchange(xy, tour, place, near, a, -1, last)
                for size in range(1, 4):
                    more = more or _move(xy, tour, place, near, a, size, last)
                if more:
                    changed = True
                    done += 1
    step = 1 if tour[(place[0] + 1) % n] != last or n == 2 else -1
    found = np.empty(n, np.int64)
    for k in range(n):
        found[k] = tour[(place[0] + step * k) % n]
    return found
