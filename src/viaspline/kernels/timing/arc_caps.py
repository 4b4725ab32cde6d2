"""How far a curve lets the speed rise: arcs, each with the largest v² that its curvature allows."""

from __future__ import annotations

import numpy as np

from viaspline.kernels.arrays import Flags, Floats
from viaspline.kernels.curve.cusps import SAME_CUSP, beside_cusps, cusps
from viaspline.kernels.curve.straight_span import runs_straight, span_rounding
from viaspline.kernels.jit import inner, kernel

_GAUSS_AT = np.array([-0.906179845938664, -0.5384693101056831, 0.0,
                      0.5384693101056831, 0.906179845938664])  # fmt: skip
_GAUSS_WEIGHT = np.array([0.23692688505618908, 0.47862867049936647, 0.5688888888888889,
                          0.47862867049936647, 0.23692688505618908])  # fmt: skip

_LEAST_WIDTH = 1.0 / 256.0  # of a span: narrower arcs are bounded as well as rounding lets them be


@inner
def _wedge(a: Floats, b: Floats) -> float:
    """|a × b| in any dimension."""
    total = 0.0
    for i in range(a.shape[0]):
        for j in range(i + 1, a.shape[0]):
            w = a[i] * b[j] - a[j] * b[i]
            total += w * w
    return float(np.sqrt(total))


@inner
def _hodograph(span: Floats, q: Floats) -> None:
    """Bézier control vectors of the derivative of a span, shape (3, d)."""
    for k in range(3):
        for j in range(span.shape[1]):
            q[k, j] = 3.0 * (span[k + 1, j] - span[k, j])


@inner
def _restrict(q: Floats, a: float, b: float, r: Floats) -> None:
    """Control vectors of the quadratic ``q`` on [a, b], by blossoming."""
    for j in range(q.shape[1]):
        for k in range(3):
            x = a if k < 2 else b
            y = a if k < 1 else b
            r[k, j] = (
                (1.0 - x) * (1.0 - y) * q[0, j]
                + ((1.0 - x) * y + x * (1.0 - y)) * q[1, j]
                + x * y * q[2, j]
            )


@inner
def _cubed(square: float) -> float:
    return float(square * np.sqrt(square))


@inner
def _curvature_bounds(r: Floats, width: float) -> tuple[float, float, float]:
    """Largest curvature that an arc can have; the smallest and largest of its ends and its middle.

    The derivative has the control vectors r0, r1, r2, so P' × P'' has the Bernstein coefficients
    2 r0×r1, r0×r2, 2 r1×r2 and |P'|² those below; a polynomial lies between its smallest and
    its largest coefficient. The bound is infinite where |P'|² isn't proven to be above 0.
    """
    w0 = 2.0 * _wedge(r[0], r[1]) / width
    w1 = _wedge(r[0], r[2]) / width
    w2 = 2.0 * _wedge(r[1], r[2]) / width
    g0, g01, g02, g11, g12, g2 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(r.shape[1]):
        g0 += r[0, j] * r[0, j]
        g01 += r[0, j] * r[1, j]
        g02 += r[0, j] * r[2, j]
        g11 += r[1, j] * r[1, j]
        g12 += r[1, j] * r[2, j]
        g2 += r[2, j] * r[2, j]
    low = min(g0, g01, (g02 + 2.0 * g11) / 3.0, g12, g2)
    if low <= 0.0:
        return np.inf, 0.0, 0.0
    middle, wedge = 0.0, 0.0
    for i in range(r.shape[1]):
        at_i = 0.25 * (r[0, i] + 2.0 * r[1, i] + r[2, i])
        middle += at_i * at_i
        for j in range(i + 1, r.shape[1]):
            at_j = 0.25 * (r[0, j] + 2.0 * r[1, j] + r[2, j])
            w = at_i * (r[2, j] - r[0, j]) - at_j * (r[2, i] - r[0, i])
            wedge += w * w
    first, last = w0 / _cubed(g0), w2 / _cubed(g2)
    within = np.sqrt(wedge) / (width * _cubed(middle))
    least, most = min(first, last, within), max(first, last, within)
    return max(w0, w1, w2) / _cubed(low), least, most


@inner
def _arc_length(q: Floats, a: float, b: float) -> float:
    half = 0.5 * (b - a)
    total = 0.0
    for k in range(_GAUSS_AT.shape[0]):
        u = 0.5 * (a + b) + half * _GAUSS_AT[k]
        square = 0.0
        for j in range(q.shape[1]):
            v = (1 - u) * (1 - u) * q[0, j] + 2 * u * (1 - u) * q[1, j] + u * u * q[2, j]
            square += v * v
        total += _GAUSS_WEIGHT[k] * np.sqrt(square)
    return half * total


@inner
def _end_tangent(span: Floats, at_end: bool, tangent: Floats) -> float:
    """Unit tangent at one end of a span; returns the length of the handle it was taken from."""
    length = 0.0
    for k in range(1, 4):
        length = 0.0
        for j in range(span.shape[1]):
            tangent[j] = span[3, j] - span[3 - k, j] if at_end else span[k, j] - span[0, j]
            length += tangent[j] * tangent[j]
        length = np.sqrt(length)
        if length > 0.0:
            for j in range(span.shape[1]):
                tangent[j] /= length
            break
    return length


@inner
def _grown(distances: Floats, caps: Floats, rests: Flags) -> tuple[Floats, Floats, Flags]:
    """A table with twice the room."""
    size = caps.shape[0]
    more = np.zeros(2 * size + 1), np.zeros(2 * size), np.zeros(2 * size + 1, np.bool_)
    for k in range(size + 1):
        more[0][k], more[2][k] = distances[k], rests[k]
    for k in range(size):
        more[1][k] = caps[k]
    return more


@inner
def _turns(before: Floats, after: Floats, slip: float) -> bool:
    """Whether two unit tangents differ."""
    turn = 0.0
    for j in range(after.shape[0]):
        turn += (after[j] - before[j]) ** 2
    return bool(np.sqrt(turn) > 1e-5 + slip)


@inner
def _arc_cap(
    r: Floats,
    width: float,
    lateral: float,
    turning: float,
    accel: float,
    top: float,
    tolerance: float,
) -> tuple[float, bool]:
    """The largest v² on an arc, and whether halving it would not be worth while.

    A short arc is worth it where its bound is far from what it bends: however short, it slows down
    what is before and behind it.
    """
    bound, least, most = _curvature_bounds(r, width)
    cap = top
    if bound > 0.0:
        cap = min(top, lateral / bound, (turning / bound) ** 2)
    if cap >= top or bound <= tolerance * least:
        return cap, True
    if bound > tolerance * most and width > _LEAST_WIDTH:
        return cap, False
    longest = 0.0
    for k in range(3):
        square = 0.0
        for j in range(r.shape[1]):
            square += r[k, j] * r[k, j]
        longest = max(longest, np.sqrt(square) * width)
    return cap, accel * longest <= 0.5 * (tolerance - 1.0) * cap


@inner
def _next_arc(
    q: Floats,
    r: Floats,
    stack: Floats,
    depth: int,
    lateral: float,
    turning: float,
    accel: float,
    top: float,
    tolerance: float,
) -> tuple[int, float, float, float, bool]:
    """Take the next arc of a span from the stack, halving it until it is fine enough.

    Returns:
        The depth of the stack that is left, the arc's ends, the largest v² on it, and whether it
        is a cusp: too short to be halved and its curvature still not bounded.
    """
    while True:
        depth -= 1
        a, b = stack[depth, 0], stack[depth, 1]
        _restrict(q, a, b, r)
        cap, fine = _arc_cap(r, b - a, lateral, turning, accel, top, tolerance)
        if fine:
            return depth, a, b, cap, False
        if b - a < 1e-9:
            return depth, a, b, top, True
        middle = 0.5 * (a + b)
        stack[depth, 0], stack[depth, 1] = middle, b
        stack[depth + 1, 0], stack[depth + 1, 1] = a, middle
        depth += 2


@inner
def _parts_between_turns(k: int, turns: Floats, beside: Floats, parts: Floats) -> int:
    """Cut a span where it turns on the spot without quite a cusp; in how many parts.

    Args:
        k: The span.
        turns: Parameters of cusps, in order.
        beside: How far in the parameter a path turns about each; none at true cusps.
        parts: Filled in: begin, end, and 1 or 2 before and behind where it turns, else 0.
    """
    count, begin = 0, 0.0
    for i in range(turns.size):
        at = turns[i] - k
        if not begin < at < 1.0 or beside[i] <= SAME_CUSP:
            continue
        first, last = max(at - beside[i], begin), min(at + beside[i], 1.0)
        parts[count, 0], parts[count, 1], parts[count, 2] = begin, first, 0.0
        parts[count + 1, 0], parts[count + 1, 1], parts[count + 1, 2] = first, at, 1.0
        parts[count + 2, 0], parts[count + 2, 1], parts[count + 2, 2] = at, last, 2.0
        count, begin = count + 3, last
    parts[count, 0], parts[count, 1], parts[count, 2] = begin, 1.0, 0.0
    return count + 1


@kernel
def bend_caps(
    spans: Floats,
    joints: Floats,
    lateral: float,
    turning: float,
    accel: float,
    top: float,
    tolerance: float,
) -> tuple[Floats, Floats, Flags]:
    """Split a curve into arcs, each with the largest v² that its curvature allows.

    Arcs are halved until the largest curvature of each is at most ``tolerance`` times its
    smallest, or until they are so short that the acceleration can't use what finer ones allow.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, d).
        joints: Distance along the curve of the ends of the spans [m], shape (m + 1,).
        lateral: Largest v² times curvature [m/s²], inf for no limit.
        turning: Largest v times curvature [rad/s], inf for no limit.
        accel: Largest acceleration along the curve [m/s²].
        top: v² that nothing may exceed [m²/s²].
        tolerance: More than 1; the nearer to 1, the more arcs and the faster the profile.

    Returns:
        Ends of the arcs as distances (k + 1,), v² for each arc (k,), and whether the robot has to
        come to rest at an end, because the curve has a corner or a cusp there (k + 1,).
    """
    m, d = spans.shape[0], spans.shape[2]
    size = 8 * m + 256
    distances, caps, rests = np.zeros(size + 1), np.zeros(size), np.zeros(size + 1, np.bool_)
    distances[0] = joints[0]
    count = 0
    q, r, before, after = np.empty((3, d)), np.empty((3, d)), np.empty(d), np.empty(d)
    stack, parts = np.empty((64, 2)), np.empty((7, 3))
    turns = cusps(spans)
    beside = beside_cusps(spans, turns)
    for i in range(m):
        length = joints[i + 1] - joints[i]
        if length <= 0.0:
            continue
        _hodograph(spans[i], q)
        noise = span_rounding(spans, i)
        handle = _end_tangent(spans[i], False, after)
        rests[count] |= count > 0 and _turns(before, after, noise / handle)
        _end_tangent(spans[i], True, before)
        is_straight = runs_straight(spans, i, noise)
        first, summed = count, 0.0
        for part in range(_parts_between_turns(i, turns, beside, parts)):
            stack[0, 0], stack[0, 1] = parts[part, 0], parts[part, 1]
            depth = 1
            while depth > 0:
                depth -= 1
                a, b, cap, cusp = stack[depth, 0], stack[depth, 1], top, False
                if not is_straight and parts[part, 2] == 0.0:
                    depth, a, b, cap, cusp = _next_arc(
                        q, r, stack, depth + 1, lateral, turning, accel, top, tolerance
                    )
                piece = _arc_length(q, a, b)
                if piece <= 0.0:
                    continue
                if count == size:
                    distances, caps, rests = _grown(distances, caps, rests)
                    size *= 2
                rests[count] |= cusp or parts[part, 2] == 2.0
                rests[count + 1] |= cusp
                summed += piece
                caps[count] = cap
                count += 1
                distances[count] = summed
        for k in range(first + 1, count + 1):
            distances[k] = joints[i] + distances[k] * length / summed
        distances[count] = joints[i + 1]
    return distances[: count + 1], caps[:count], rests[: count + 1]
