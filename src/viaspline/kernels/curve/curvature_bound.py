"""A proven upper bound of the curvature of each span of a piecewise cubic, and its corners.

With P' = V, curvature is |V × V'| / |V|³. Over a piece, V × V' and |V|² lie in the hulls of their
Bernstein coefficients, whose quotient bounds the curvature: to first order in the piece's width.
Where that is not enough, that all curvature is below K is that the polynomial

    K² |V|⁶ - |V × V'|²

of degree 12 has positive Bernstein coefficients, which is of second order. What neither settles is
halved. K is a little more than the largest curvature that is attained.

Tested through ``curve/test_bending``.
"""

from __future__ import annotations

import math

import numpy as np

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel

BOUND_TOLERANCE = 1e-6  # what the bound may exceed an attained value by, relative
MAX_HALVINGS = 64
MIN_CUSP_PIECE = 2.0**-46  # pieces narrower than this, in which the curve stands still, are cusps
ROUNDING_ERROR = 4e-15
NEGLIGIBLE_SHARE = 1e-12  # beside a span's largest number, what is only rounding
MAX_SPEED_RATIO = 64.0  # |V|² may vary so much where the polynomial is formed


@inner
def _products(v: Floats, q: Floats, y: Floats) -> None:
    """Bernstein coefficients (5,) of |V|² and of |V × V'|² over a piece of width 1."""
    dimension = v.shape[1]
    dots = np.zeros(6)
    for k in range(5):
        y[k] = 0.0
    for i in range(dimension):
        a, b, c = v[0, i], v[1, i], v[2, i]
        dots[0] += a * a
        dots[1] += a * b
        dots[2] += a * c
        dots[3] += b * b
        dots[4] += b * c
        dots[5] += c * c
        for j in range(i):
            n0 = 2.0 * (a * v[1, j] - b * v[0, j])
            n1 = a * v[2, j] - c * v[0, j]
            n2 = 2.0 * (b * v[2, j] - c * v[1, j])
            y[0] += n0 * n0
            y[1] += n0 * n1
            y[2] += (n0 * n2 + 2.0 * n1 * n1) / 3.0
            y[3] += n1 * n2
            y[4] += n2 * n2
    q[0] = dots[0]
    q[1] = dots[1]
    q[2] = (dots[2] + 2.0 * dots[3]) / 3.0
    q[3] = dots[4]
    q[4] = dots[5]


@inner
def _choose(n: int, k: int) -> float:
    value = 1.0
    for i in range(k):
        value = value * (n - i) / (i + 1)
    return value


@inner
def _multiply(a: Floats, b: Floats, out: Floats) -> None:
    """Product of two polynomials in Bernstein form."""
    n = a.shape[0] - 1
    m = b.shape[0] - 1
    for i in range(n + m + 1):
        out[i] = 0.0
    for i in range(n + 1):
        for j in range(m + 1):
            out[i + j] += _choose(n, i) * _choose(m, j) * a[i] * b[j]
    for i in range(n + m + 1):
        out[i] /= _choose(n + m, i)


@inner
def _is_below(q: Floats, y: Floats, squared: float) -> bool:
    """Whether squared * q³ - y is positive: both are degree 4, Bernstein."""
    ones = np.ones(9)
    square = np.empty(9)
    cube = np.empty(13)
    raised = np.empty(13)
    _multiply(q, q, square)
    _multiply(square, q, cube)
    _multiply(y, ones, raised)
    least = np.inf
    for k in range(13):
        least = min(least, squared * cube[k] - raised[k])
    return bool(least > 0.0)


@inner
def _at(v: Floats, width: float, t: float) -> float:
    """Curvature at t in [0, 1] of a piece; 0 where the curve stands still."""
    s = 1.0 - t
    speed = 0.0
    ahead = 0.0
    bend = 0.0
    for i in range(v.shape[1]):
        a = s * s * v[0, i] + 2.0 * s * t * v[1, i] + t * t * v[2, i]
        b = 2.0 * (s * (v[1, i] - v[0, i]) + t * (v[2, i] - v[1, i]))
        speed += a * a
        ahead += a * b
        bend += b * b
    if speed == 0.0:
        return 0.0
    across = 0.0
    for i in range(v.shape[1]):
        a = s * s * v[0, i] + 2.0 * s * t * v[1, i] + t * t * v[2, i]
        b = 2.0 * (s * (v[1, i] - v[0, i]) + t * (v[2, i] - v[1, i]))
        across += (b - ahead / speed * a) ** 2
    return math.sqrt(across) / (speed * width)


@inner
def _halve(v: Floats, other: Floats) -> None:
    """The second half of a quadratic in place, the first half into ``other``."""
    for i in range(v.shape[1]):
        a = 0.5 * (v[0, i] + v[1, i])
        b = 0.5 * (v[1, i] + v[2, i])
        other[0, i] = v[0, i]
        other[1, i] = a
        other[2, i] = 0.5 * (a + b)
        v[0, i] = other[2, i]
        v[1, i] = b


@inner
def _load(spans: Floats, span: int, v: Floats) -> tuple[float, float]:
    """Control vectors of the derivative into ``v`` (3, d).

    A vector that is only rounding beside the others is none.

    Returns:
        (the largest number among them, 0 for a single point; the largest coordinate).
    """
    largest = 0.0
    size = 0.0
    for k in range(3):
        for i in range(spans.shape[2]):
            v[k, i] = 3.0 * (spans[span, k + 1, i] - spans[span, k, i])
            largest = max(largest, abs(v[k, i]))
            size = max(size, abs(spans[span, k, i]))
    noise = max(NEGLIGIBLE_SHARE * largest, ROUNDING_ERROR * size)
    for k in range(3):
        small = True
        for i in range(spans.shape[2]):
            small = small and abs(v[k, i]) <= noise
        for i in range(spans.shape[2]):
            v[k, i] = 0.0 if small else v[k, i]
    return (0.0 if largest <= noise else largest), size


@inner
def turning_point(v: Floats, scale: float) -> float:
    """Where a straight span turns back, by the control vectors (3, d) of its derivative; else -1.

    Args:
        v: The vectors, all along one line.
        scale: The largest number among them.
    """
    longest = 0
    sizes = np.zeros(3)
    for k in range(3):
        for i in range(v.shape[1]):
            sizes[k] += v[k, i] * v[k, i]
        if sizes[k] > sizes[longest]:
            longest = k
    size = math.sqrt(sizes[longest])
    along = np.zeros(3)
    for k in range(3):
        for i in range(v.shape[1]):
            along[k] += v[k, i] * v[longest, i] / size
    bend = along[0] - 2.0 * along[1] + along[2]
    middle = (along[0] - along[1]) / bend if bend != 0.0 else -1.0
    low = 0.0
    high = 0.0
    where = -1.0
    for w in (0.0, min(max(middle, 0.0), 1.0), 1.0):
        value = (1.0 - w) * ((1.0 - w) * along[0] + 2.0 * w * along[1]) + w * w * along[2]
        low = min(low, value)
        high = max(high, value)
        if where < 0.0 and low < -NEGLIGIBLE_SHARE * scale < NEGLIGIBLE_SHARE * scale < high:
            where = w
    return where


@inner
def is_straight(v: Floats, scale: float, size: float) -> bool:
    """Whether the control vectors (3, d) of a span's derivative lie along one line.

    Args:
        v: The vectors.
        scale: The largest number among them.
        size: The largest coordinate of the span, for what is only rounding.
    """
    bend = 0.0
    for i in range(v.shape[1]):
        for j in range(i):
            for k in range(3):
                for m in range(k):
                    bend = max(bend, abs(v[k, i] * v[m, j] - v[k, j] * v[m, i]))
    return bend <= 4.0 * ROUNDING_ERROR * scale * max(scale, size)


@inner
def _span_bound(
    stack: Floats, ends: Floats, q: Floats, y: Floats, least: float
) -> tuple[float, float, float]:
    """Bound one span's curvature, whose vectors are in ``stack[0]``.

    Args:
        stack: Room, (DEPTH, 3, d).
        ends: The same, (DEPTH, 2): first parameter and width.
        q: Room, (5,).
        y: The same.
        least: Curvature below which nobody needs to know more [1/m].

    Returns:
        (upper bound, largest curvature attained, where); the bound may be ``least`` itself.
    """
    best = 0.0
    where = 0.0
    ends[0, 0] = 0.0
    ends[0, 1] = 1.0
    top = 0
    while top >= 0:
        v = stack[top]
        start = ends[top, 0]
        width = ends[top, 1]
        for k in range(3):
            here = _at(v, width, 0.5 * k)
            if here > best:
                best = here
                where = start + 0.5 * k * width
        _products(v, q, y)
        low, high, bend = q[0], q[0], y[0]
        for k in range(1, 5):
            low = min(low, q[k])
            high = max(high, q[k])
            bend = max(bend, y[k])
        limit = max(best * (1.0 + 0.5 * BOUND_TOLERANCE), least)
        squared = limit * limit * width * width
        proven = low > 0.0 and bend <= squared * low * low * low
        if not proven and low > 0.0 and high < MAX_SPEED_RATIO * low:
            proven = _is_below(q, y, squared)
        if proven:
            top -= 1
        elif width < MIN_CUSP_PIECE or top + 2 > stack.shape[0]:
            return np.inf, np.inf, start
        else:
            _halve(v, stack[top + 1])
            ends[top + 1, 0] = start
            ends[top + 1, 1] = 0.5 * width
            ends[top, 0] = start + 0.5 * width
            ends[top, 1] = 0.5 * width
            top += 1
    return max(best * (1.0 + BOUND_TOLERANCE), least), best, where


@kernel
def curvature_bounds(spans: Floats, least: float) -> tuple[Floats, Floats, Floats]:
    """Proven upper bounds of the curvature of each span.

    Args:
        spans: Bézier control polygons, (m, 4, d) [m].
        least: Curvature below which nobody needs to know more [1/m]; 0 for the largest as it is.

    Returns:
        (upper (m,), attained (m,), w (m,)): no curvature without its sign is above ``upper``,
        which is ``attained`` and a millionth, or ``least``; it is infinite at a cusp inside of a
        span or at its end, where the curve stands still and bends.
    """
    count = spans.shape[0]
    upper = np.empty(count)
    attained = np.empty(count)
    where = np.zeros(count)
    stack = np.empty((MAX_HALVINGS, 3, spans.shape[2]))
    ends = np.empty((MAX_HALVINGS, 2))
    q = np.empty(5)
    y = np.empty(5)
    for span in range(count):
        scale, size = _load(spans, span, stack[0])
        if scale == 0.0 or is_straight(stack[0], scale, size):
            back = -1.0 if scale == 0.0 else turning_point(stack[0], scale)
            attained[span] = np.inf if back >= 0.0 else 0.0
            upper[span] = max(attained[span], least)
            where[span] = max(back, 0.0)
            continue
        upper[span], attained[span], where[span] = _span_bound(stack, ends, q, y, least)
    return upper, attained, where


@kernel
def corners(spans: Floats, closed: bool) -> Floats:
    """The angle by which the tangent jumps at every joint [rad], (m + 1,).

    Args:
        spans: Bézier control polygons, (m, 4, d) [m].
        closed: Whether the last span ends where the first starts; the seam counts at both ends.

    Returns:
        In [0, pi]; 0 at the ends of an open curve, and where a span is a single point: the jump
        over it counts at its end.
    """
    count, _, dimension = spans.shape
    angle = np.zeros(count + 1)
    v = np.empty((3, dimension))
    before = np.zeros(dimension)
    known = False
    for turn in range(2 * count if closed else count):
        span = turn % count
        scale, _ = _load(spans, span, v)
        if scale == 0.0:
            continue
        for last in range(2):
            k = 2 * last
            for _ in range(2):  # the first vector that is not zero
                size = 0.0
                for i in range(dimension):
                    size = max(size, abs(v[k, i]))
                if size == 0.0:
                    k += 1 - 2 * last
            if last == 0 and known:
                angle[span] = _between(before, v[k])
            for i in range(dimension):
                before[i] = v[k, i]
            known = True
    if closed:
        angle[count] = angle[0]
    return angle


@inner
def _between(a: Floats, b: Floats) -> float:
    """Angle between two vectors [rad]: exact for small ones too."""
    length_a = 0.0
    length_b = 0.0
    for i in range(a.shape[0]):
        length_a += a[i] * a[i]
        length_b += b[i] * b[i]
    length_a = math.sqrt(length_a)
    length_b = math.sqrt(length_b)
    apart = 0.0
    along = 0.0
    for i in range(a.shape[0]):
        apart += (a[i] / length_a - b[i] / length_b) ** 2
        along += (a[i] / length_a + b[i] / length_b) ** 2
    return 2.0 * math.atan2(math.sqrt(apart), math.sqrt(along))
