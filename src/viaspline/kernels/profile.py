"""The time law: how far a curve lets the speed rise, and the fastest profile below that.

Everything is done in v², which is linear in distance where the acceleration is constant; so a
profile given at its break points is exact between them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.jit import kernel

Floats = NDArray[np.float64]
Flags = NDArray[np.bool_]

_GAUSS_AT = np.array([-0.906179845938664, -0.5384693101056831, 0.0,
                      0.5384693101056831, 0.906179845938664])  # fmt: skip
_GAUSS_WEIGHT = np.array([0.23692688505618908, 0.47862867049936647, 0.5688888888888889,
                          0.47862867049936647, 0.23692688505618908])  # fmt: skip


@kernel
def _wedge(a: Floats, b: Floats) -> float:
    """|a × b| in any dimension."""
    total = 0.0
    for i in range(a.shape[0]):
        for j in range(i + 1, a.shape[0]):
            w = a[i] * b[j] - a[j] * b[i]
            total += w * w
    return float(np.sqrt(total))


@kernel
def _hodograph(span: Floats, q: Floats) -> None:
    """Bézier control vectors of the derivative of a span, shape (3, d)."""
    for k in range(3):
        for j in range(span.shape[1]):
            q[k, j] = 3.0 * (span[k + 1, j] - span[k, j])


@kernel
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


@kernel
def _cubed(square: float) -> float:
    return float(square * np.sqrt(square))


@kernel
def _largest(values: Floats) -> float:
    largest = 0.0
    for row in range(values.shape[0]):
        for j in range(values.shape[1]):
            largest = max(largest, abs(values[row, j]))
    return largest


@kernel
def _curvature_bounds(r: Floats, width: float) -> tuple[float, float]:
    """Largest curvature that an arc can have, and the smallest of its ends and its middle.

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
        return np.inf, 0.0
    middle, wedge = 0.0, 0.0
    for i in range(r.shape[1]):
        at_i = 0.25 * (r[0, i] + 2.0 * r[1, i] + r[2, i])
        middle += at_i * at_i
        for j in range(i + 1, r.shape[1]):
            at_j = 0.25 * (r[0, j] + 2.0 * r[1, j] + r[2, j])
            w = at_i * (r[2, j] - r[0, j]) - at_j * (r[2, i] - r[0, i])
            wedge += w * w
    least = min(w0 / _cubed(g0), w2 / _cubed(g2), np.sqrt(wedge) / (width * _cubed(middle)))
    return max(w0, w1, w2) / _cubed(low), least


@kernel
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


@kernel
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


@kernel
def _grown(distances: Floats, caps: Floats, rests: Flags) -> tuple[Floats, Floats, Flags]:
    """The same with twice the room."""
    size = caps.shape[0]
    more = np.zeros(2 * size + 1), np.zeros(2 * size), np.zeros(2 * size + 1, np.bool_)
    for k in range(size + 1):
        more[0][k], more[2][k] = distances[k], rests[k]
    for k in range(size):
        more[1][k] = caps[k]
    return more


@kernel
def bend_caps(
    spans: Floats, joints: Floats, lateral: float, accel: float, top: float, tolerance: float
) -> tuple[Floats, Floats, Flags]:
    """Split a curve into arcs, each with the largest v² that its curvature allows.

    Arcs are halved until the largest curvature of each is at most ``tolerance`` times its
    smallest, or until they are so short that the acceleration can't use what finer ones allow.

    Args:
        spans: Bézier control polygons [m], shape (m, 4, d).
        joints: Distance along the curve of the ends of the spans [m], shape (m + 1,).
        lateral: Largest v² times curvature [m/s²].
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
    stack = np.empty((64, 2))
    short = 0.5 * (tolerance - 1.0)
    arrived = False
    for i in range(m):
        span_length = joints[i + 1] - joints[i]
        if span_length <= 0.0:
            continue
        _hodograph(spans[i], q)
        noise = 2.0**-46 * (_largest(spans[i]) + _largest(q))
        handle = _end_tangent(spans[i], False, after)
        if arrived:
            turn = 0.0
            for j in range(d):
                turn += (after[j] - before[j]) ** 2
            if np.sqrt(turn) > 1e-5 + noise / handle:
                rests[count] = True
        straight = noise * _largest(q)
        is_straight = max(_wedge(q[0], q[1]), _wedge(q[0], q[2]), _wedge(q[1], q[2])) <= straight
        first, summed = count, 0.0
        stack[0, 0], stack[0, 1] = 0.0, 1.0
        depth = 1
        while depth > 0:
            depth -= 1
            a, b = stack[depth, 0], stack[depth, 1]
            cap, unresolved = top, False
            if not is_straight:
                _restrict(q, a, b, r)
                bound, least = _curvature_bounds(r, b - a)
                cap = min(top, lateral / bound) if bound > 0.0 else top
                longest = 0.0
                for k in range(3):
                    square = 0.0
                    for j in range(d):
                        square += r[k, j] * r[k, j]
                    longest = max(longest, np.sqrt(square) * (b - a))
                fine = cap >= top or bound <= tolerance * least or accel * longest <= short * cap
                unresolved = not fine and (b - a < 1e-9 or depth > 60)
                if not fine and not unresolved:
                    middle = 0.5 * (a + b)
                    stack[depth, 0], stack[depth, 1] = middle, b
                    stack[depth + 1, 0], stack[depth + 1, 1] = a, middle
                    depth += 2
                    continue
            piece = span_length if a == 0.0 and b == 1.0 else _arc_length(q, a, b)
            if piece <= 0.0:
                continue
            if count == size:
                distances, caps, rests = _grown(distances, caps, rests)
                size *= 2
            if unresolved:
                rests[count], rests[count + 1] = True, True
                cap = top
            summed += piece
            caps[count] = cap
            count += 1
            distances[count] = summed
        scale = span_length / summed if summed > 0.0 else 1.0
        for k in range(first + 1, count + 1):
            distances[k] = joints[i] + distances[k] * scale
        distances[count] = joints[i + 1]
        _end_tangent(spans[i], True, before)
        arrived = True
    distances[count] = joints[m]
    return distances[: count + 1], caps[:count], rests[: count + 1]


@kernel
def speed_profile(
    distances: Floats, caps: Floats, rests: Flags, accel: float, first: float, last: float
) -> tuple[Floats, Floats, float, float]:
    """The fastest v² along a line of stretches, by a backward and a forward pass.

    Args:
        distances: Ends of the stretches [m], increasing, shape (n,).
        caps: Largest v² on every stretch [m²/s²], shape (n - 1,).
        rests: Where v is 0, shape (n,).
        accel: Largest acceleration and deceleration [m/s²].
        first: v² at the start. If it is more than the caps allow, the profile brakes with
            ``accel`` until it is below them.
        last: v² at the end.

    Returns:
        Break points (k,) and v² there (k,), between which v² is linear; the distance up to which
        the profile is above the caps (the start if it never is); the first place where it can't
        come to rest as it should (nan if there is none).
    """
    n = distances.shape[0]
    back = np.empty(n)
    back[n - 1] = 0.0 if rests[n - 1] else min(last, caps[n - 2])
    for i in range(n - 2, -1, -1):
        limit = caps[i] if i == 0 else min(caps[i], caps[i - 1])
        reach = back[i + 1] + 2.0 * accel * (distances[i + 1] - distances[i])
        back[i] = 0.0 if rests[i] else min(limit, reach)
    s, e = np.empty(3 * n), np.empty(3 * n)
    count = 1
    s[0], e[0] = distances[0], first
    over, missed = distances[0], np.nan
    is_over = first > back[0] * (1.0 + 1e-9) + 1e-12
    if not is_over:
        e[0] = min(first, back[0])
    elif rests[0]:
        missed = distances[0]
    for i in range(n - 1):
        left, right, cap = distances[i], distances[i + 1], caps[i]
        low = e[count - 1]
        if is_over:
            brake = low - 2.0 * accel * (right - left)
            if brake > back[i + 1] * (1.0 + 1e-9) + 1e-12:
                if np.isnan(missed) and (rests[i + 1] or i == n - 2):
                    missed = right
                over = right
                s[count], e[count] = right, brake
                count += 1
                continue
            is_over = False
            over = left
            if low > cap:
                over = left + (low - cap) / (2.0 * accel)
                if over < right:
                    left, low = over, cap
                    s[count], e[count] = left, low
                    count += 1
                else:
                    over = right
        width = right - left
        high = min(back[i + 1], max(low, 0.0) + 2.0 * accel * width)
        rise, fall = (cap - low) / (2.0 * accel), width - (cap - high) / (2.0 * accel)
        if rise < fall:
            if 0.0 < rise < width:
                s[count], e[count] = left + rise, cap
                count += 1
            if 0.0 < fall < width:
                s[count], e[count] = left + fall, cap
                count += 1
        else:
            peak = (high - low + 2.0 * accel * width) / (4.0 * accel)
            if 0.0 < peak < width:
                s[count], e[count] = left + peak, low + 2.0 * accel * peak
                count += 1
        s[count], e[count] = right, high
        count += 1
    return s[:count], np.maximum(e[:count], 0.0), over, missed
