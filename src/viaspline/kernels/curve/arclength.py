"""Distance along a piecewise cubic: adaptive Gauss-Legendre panels, and the way back.

Every span is halved until eight nodes integrate the speed |P'| of each panel to the tolerance. A
part of a panel is then integrated as well by the same eight nodes, so that the distance of any
parameter costs one look into the table of panels and eight speeds. ``rows`` are the Taylor
coefficients of ``kernels.curve.cubic``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve.cubic import wrapped
from viaspline.kernels.jit import inner, kernel

_NODES, _WEIGHTS = (half[4:] for half in np.polynomial.legendre.leggauss(8))
LENGTH_TOLERANCE = 1e-10  # of a span's longest possible length
MIN_PANEL = 2.0**-36  # panel


@kernel
def speed(rows: Floats, k: int, w: float) -> float:
    """|P'(w)| on row k [m per unit of the parameter]."""
    if rows.shape[2] == 2:  # loops of a known length are unrolled
        x = rows[k, 1, 0] + w * (2.0 * rows[k, 2, 0] + 3.0 * w * rows[k, 3, 0])
        y = rows[k, 1, 1] + w * (2.0 * rows[k, 2, 1] + 3.0 * w * rows[k, 3, 1])
        return math.sqrt(x * x + y * y)
    squared = 0.0
    for axis in range(rows.shape[2]):
        c = 2.0 * rows[k, 2, axis] + 3.0 * w * rows[k, 3, axis]
        step = rows[k, 1, axis] + w * c
        squared += step * step
    return math.sqrt(squared)


@inner
def panel_length(rows: Floats, k: int, start: float, end: float) -> float:
    """Length of row k from local parameter ``start`` to ``end`` by eight nodes [m]."""
    middle = 0.5 * (start + end)
    half = 0.5 * (end - start)
    total = 0.0
    for node in range(_NODES.shape[0]):
        step = half * _NODES[node]
        pair = speed(rows, k, middle - step) + speed(rows, k, middle + step)
        total += _WEIGHTS[node] * pair
    return half * total


@inner
def _longest(rows: Floats, k: int, start: float, end: float) -> float:
    """Upper bound of a panel's length where P' may turn by a right angle or more; else 0.

    There the speed can have a kink that falls between the nodes. The control vectors of P' on the
    panel bound its direction and its length.
    """
    half = 0.5 * (end - start)
    products = np.zeros((3, 3))
    for axis in range(rows.shape[2]):
        bend = 2.0 * rows[k, 2, axis]
        twist = 3.0 * rows[k, 3, axis]
        first = rows[k, 1, axis] + start * (bend + start * twist)
        last = rows[k, 1, axis] + end * (bend + end * twist)
        middle = first + half * (bend + 2.0 * start * twist)
        products[0, 0] += first * first
        products[1, 1] += middle * middle
        products[2, 2] += last * last
        products[0, 1] += first * middle
        products[0, 2] += first * last
        products[1, 2] += middle * last
    largest = max(products[0, 0], products[1, 1], products[2, 2])
    least = min(products[0, 1], products[0, 2], products[1, 2])
    if least >= -1e-14 * largest:
        return 0.0
    return 2.0 * half * math.sqrt(largest)


@inner
def _larger(array: Floats) -> Floats:
    """Numbers in a table with as much room again."""
    larger = np.zeros(2 * array.shape[0])
    for i in range(array.shape[0]):
        larger[i] = array[i]
    return larger


@kernel
def length_table(rows: Floats) -> tuple[Floats, Floats]:
    """Panels of a whole curve.

    Args:
        rows: (m + 1, 4, d).

    Returns:
        (at (p + 1,), along (p + 1,)): the parameters where panels meet, among them every joint,
        and the distances there [m]. Relative error below 1e-9.
    """
    count = rows.shape[0] - 1
    at = np.zeros(4 * count + 64)
    along = np.zeros(4 * count + 64)
    size = 1
    stack = np.empty((40, 3))
    for k in range(count):
        stack[0, 0] = 0.0
        stack[0, 1] = 1.0
        stack[0, 2] = panel_length(rows, k, 0.0, 1.0)
        top = 0
        allowed = 0.0
        for j in range(9):
            allowed = max(allowed, LENGTH_TOLERANCE * speed(rows, k, j / 8.0))
        while top >= 0:
            start = stack[top, 0]
            end = stack[top, 1]
            middle = 0.5 * (start + end)
            left = panel_length(rows, k, start, middle)
            right = panel_length(rows, k, middle, end)
            error = max(abs(left + right - stack[top, 2]), _longest(rows, k, start, end))
            if error <= allowed or end - start <= MIN_PANEL:
                if size + 2 > at.shape[0]:
                    at = _larger(at)
                    along = _larger(along)
                at[size] = k + middle
                along[size] = along[size - 1] + left
                at[size + 1] = k + end
                along[size + 1] = along[size] + right
                size += 2
                top -= 1
            else:
                stack[top, 0] = middle
                stack[top, 2] = right
                top += 1
                stack[top, 0] = start
                stack[top, 1] = middle
                stack[top, 2] = left
    return at[:size].copy(), along[:size].copy()


@inner
def panel_of(values: Floats, value: float) -> int:
    """The last panel that starts at or before a value, and is not the end of the table."""
    low = 0
    high = values.shape[0] - 1
    while high - low > 1:
        middle = (low + high) // 2
        if values[middle] <= value:
            low = middle
        else:
            high = middle
    return low


@kernel
def distances(rows: Floats, at: Floats, along: Floats, u: Floats, closed: bool, out: Floats) -> int:
    """Distance along the curve of parameters [m].

    Args:
        rows: (m + 1, 4, d).
        at: Parameters of the table, (p + 1,).
        along: Distances of the table, (p + 1,).
        u: Parameters, (n,); those of a closed curve wrap.
        closed: Whether the curve is closed.
        out: (n,), filled up to the first parameter that is outside.

    Returns:
        The index of the first parameter that is outside; -1 when there is none.
    """
    count = rows.shape[0] - 1
    for i in range(u.shape[0]):
        x = wrapped(u[i], count, closed)
        if math.isnan(x):
            return i
        panel = panel_of(at, x)
        if x == at[panel + 1]:
            out[i] = along[panel + 1]
        else:
            k = int(at[panel])
            out[i] = along[panel] + panel_length(rows, k, at[panel] - k, x - k)
    return -1


@inner
def along_panel(
    rows: Floats, k: int, start: float, end: float, step: float, part: float, small: float
) -> float:
    """Local parameter at which a panel has the length ``step``, to within ``small`` [m].

    Newton's steps inside a bracket, from a first guess at ``part`` of the panel.
    """
    low = start
    high = end
    w = start + part * (end - start)
    for _ in range(80):
        excess = panel_length(rows, k, start, w) - step
        if abs(excess) <= small:
            return w
        if excess > 0.0:
            high = w
        else:
            low = w
        rate = speed(rows, k, w)
        w = w - excess / rate if rate > 0.0 else low
        if not low < w < high:
            w = 0.5 * (low + high)
    return w


@kernel
def parameters(
    rows: Floats, at: Floats, along: Floats, s: Floats, closed: bool, out: Floats
) -> int:
    """Parameters at distances along the curve; arguments and answer as in ``distances``."""
    length = along[along.shape[0] - 1]
    for i in range(s.shape[0]):
        x = s[i]
        if not 0.0 <= x <= length:
            if not (closed and abs(x) < np.inf and length > 0.0):
                return i
            x = min(max(x - length * math.floor(x / length), 0.0), length)
        panel = panel_of(along, x)
        if x == along[panel]:
            out[i] = at[panel]
        elif x == along[panel + 1]:
            out[i] = at[panel + 1]
        else:
            k = int(at[panel])
            step = x - along[panel]
            part = step / (along[panel + 1] - along[panel])
            end = at[panel + 1] - k
            out[i] = k + along_panel(rows, k, at[panel] - k, end, step, part, 1e-15 * length)
    return -1


@kernel
def span_length(rows: Floats, k: int) -> float:
    """Length of one row by adaptive Gauss-Legendre, relative error below 1e-9 [m]."""
    _, along = length_table(rows[k : k + 2])
    return float(along[along.shape[0] - 1])
