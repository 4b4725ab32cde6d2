"""The fastest v² under limits that couple speed and acceleration: reachability on a grid.

v² is linear on every stretch between two nodes, so the acceleration is (w1 - w0) / 2h there. Every
limit becomes half-planes p w0 + q w1 <= g of v² at both ends that hold for the whole stretch:
tangent and curvature are quadratics with bounded errors, what the limits bound is a polynomial in
the distance, and a polynomial lies below its largest Bernstein coefficient.

Source: H. Pham and Q.-C. Pham, "A new approach to time-optimal path parameterization based on
reachability analysis", IEEE Transactions on Robotics 34 (2018); R. Seidel, "Small-dimensional
linear programming and convex hulls made easy" (1991).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.jit import kernel, within

Floats = NDArray[np.float64]


@within
def _couple(
    a: Floats,
    b: Floats,
    i: int,
    miss: float,
    limit: float,
    h: float,
    planes: Floats,
    n: int,
    m: int,
) -> int:
    """Half-planes of |A(s) a + B(s) w| <= limit on a stretch, times 2h, for quadratics A and B.

    With w linear and a = (w1 - w0) / 2h the sum is a cubic in s; it is below its largest
    Bernstein coefficient, and each of the four is linear in w0 and w1.
    """
    miss, limit, double = 2.0 * h * miss, 2.0 * h * limit, 2.0 * h
    for j in range(4):
        if j == 0:
            along, p, q, e, f = a[i, 0], b[i, 0], 0.0, miss, 0.0
        elif j == 1:
            along, p, q = (a[i, 0] + 2.0 * a[i, 1]) / 3.0, 2.0 * b[i, 1] / 3.0, b[i, 0] / 3.0
            e, f = 2.0 * miss / 3.0, miss / 3.0
        elif j == 2:
            along, p, q = (2.0 * a[i, 1] + a[i, 2]) / 3.0, b[i, 2] / 3.0, 2.0 * b[i, 1] / 3.0
            e, f = miss / 3.0, 2.0 * miss / 3.0
        else:
            along, p, q, e, f = a[i, 2], 0.0, b[i, 2], 0.0, miss
        p, q = p * double, q * double
        planes[n, m, 0], planes[n, m, 1], planes[n, m, 2] = p - along + e, q + along + f, limit
        planes[n, m + 1, 0], planes[n, m + 1, 1] = along - p + e, f - q - along
        planes[n, m + 1, 2] = limit
        m += 2
    return m


@within
def _on_line(planes: Floats, n: int, r: int, top0: float, top1: float) -> tuple[float, float]:
    """The point with the largest w0 on the edge of half-plane r, in the box and those before."""
    p, q, g = planes[n, r, 0], planes[n, r, 1], planes[n, r, 2]
    norm = p * p + q * q
    at0, at1 = p * g / norm, q * g / norm
    along0, along1 = q, -p
    if along0 < 0.0:
        along0, along1 = -q, p
    low, high = -np.inf, np.inf
    for k in range(-4, r):
        if k == -4:
            slope, room = along0, top0 - at0
        elif k == -3:
            slope, room = -along0, at0
        elif k == -2:
            slope, room = along1, top1 - at1
        elif k == -1:
            slope, room = -along1, at1
        else:
            slope = planes[n, k, 0] * along0 + planes[n, k, 1] * along1
            room = planes[n, k, 2] - planes[n, k, 0] * at0 - planes[n, k, 1] * at1
        if slope > 0.0:
            high = min(high, room / slope)
        elif slope < 0.0:
            low = max(low, room / slope)
    x = high if high >= low else 0.5 * (low + high)
    return at0 + x * along0, at1 + x * along1


@within
def _largest_first(planes: Floats, n: int, m: int, top0: float, top1: float) -> float:
    """The largest w0 in [0, top0] for which some w1 in [0, top1] keeps every half-plane."""
    w0, w1 = top0, top1
    for r in range(m):
        p, q = planes[n, r, 0] * w0, planes[n, r, 1] * w1
        if p + q > planes[n, r, 2] + 1e-13 * (abs(p) + abs(q)):
            w0, w1 = _on_line(planes, n, r, top0, top1)
    return min(max(w0, 0.0), top0)


@within
def _largest_second(planes: Floats, n: int, m: int, w0: float, top1: float) -> float:
    """The largest w1 in [0, top1] that goes with w0."""
    high, low = top1, 0.0
    for r in range(m):
        room, slope = planes[n, r, 2] - planes[n, r, 0] * w0, planes[n, r, 1]
        if slope > 0.0:
            high = min(high, room / slope)
        elif slope < 0.0:
            low = max(low, room / slope)
    return min(max(low, high), top1)


@within
def _part(c: Floats, k: int, i: int, x: float, y: float, out: Floats, o: int) -> None:
    """Bernstein coefficients of a quadratic on [x, y]."""
    p, q = c[k, i, 0] + x * (c[k, i, 1] - c[k, i, 0]), c[k, i, 1] + x * (c[k, i, 2] - c[k, i, 1])
    out[o, 0], out[o, 1] = p + x * (q - p), p + y * (q - p)
    p, q = c[k, i, 0] + y * (c[k, i, 1] - c[k, i, 0]), c[k, i, 1] + y * (c[k, i, 2] - c[k, i, 1])
    out[o, 2] = p + y * (q - p)


@within
def _squared_peak(a: Floats, i: int, miss: float, c0: float, c1: float) -> float:
    """A bound of A² w on a stretch on which w is linear from c0 to c1."""
    p1, p3 = a[i, 0] * a[i, 1], a[i, 1] * a[i, 2]
    p0, p4 = a[i, 0] * a[i, 0], a[i, 2] * a[i, 2]
    p2 = (a[i, 0] * a[i, 2] + 2.0 * a[i, 1] * a[i, 1]) / 3.0
    peak = max(p0 * c0, p4 * c1)
    peak = max(peak, 0.2 * (4.0 * p1 * c0 + p0 * c1), 0.2 * (3.0 * p2 * c0 + 2.0 * p1 * c1))
    peak = max(peak, 0.2 * (2.0 * p3 * c0 + 3.0 * p2 * c1), 0.2 * (p4 * c0 + 4.0 * p3 * c1))
    most = max(abs(a[i, 0]), abs(a[i, 1]), abs(a[i, 2]))
    return peak + miss * (2.0 * most + miss) * max(c0, c1)


@within
def _bend_peak(b: Floats, miss: float, c0: float, c1: float) -> float:
    """A bound of |K| w on a stretch on which w is linear from c0 to c1."""
    peak = 0.0
    for j in range(4):
        square = 0.0
        for i in range(b.shape[0]):
            if j == 0:
                x = b[i, 0] * c0
            elif j == 1:
                x = (2.0 * b[i, 1] * c0 + b[i, 0] * c1) / 3.0
            elif j == 2:
                x = (b[i, 2] * c0 + 2.0 * b[i, 1] * c1) / 3.0
            else:
                x = b[i, 2] * c1
            square += x * x
        peak = max(peak, square)
    return np.sqrt(peak) + miss * np.sqrt(float(b.shape[0])) * max(c0, c1)


@within
def _speed_caps(
    t: Floats,
    b: Floats,
    y: Floats,
    misses: Floats,
    k: int,
    h: float,
    top: float,
    accel: float,
    axis_speed: Floats,
    lateral: float,
    yaw_rate: float,
) -> tuple[float, float]:
    """Largest v² at both ends of a stretch for which the line between them keeps every speed."""
    c0, c1 = top, top
    for i in range(axis_speed.shape[0]):
        v = axis_speed[i] * axis_speed[i]
        c0 = min(c0, v / (t[i, 0] * t[i, 0] + 1e-300))
        c1 = min(c1, v / (t[i, 2] * t[i, 2] + 1e-300))
    if lateral < np.inf:
        k0, k1 = 0.0, 0.0
        for i in range(b.shape[0]):
            k0 += b[i, 0] * b[i, 0]
            k1 += b[i, 2] * b[i, 2]
        c0, c1 = min(c0, lateral / np.sqrt(k0 + 1e-300)), min(c1, lateral / np.sqrt(k1 + 1e-300))
    if yaw_rate < np.inf:
        v = yaw_rate * yaw_rate
        c0, c1 = min(c0, v / (y[0, 0] * y[0, 0] + 1e-300)), min(c1, v / (y[0, 2] ** 2 + 1e-300))
    c0, c1 = min(c0, c1 + 2.0 * accel * h), min(c1, c0 + 2.0 * accel * h)
    share = 1.0
    for i in range(axis_speed.shape[0]):
        peak = _squared_peak(t, i, misses[k, 0], c0, c1)
        share = min(share, axis_speed[i] * axis_speed[i] / (peak + 1e-300))
    if lateral < np.inf:
        share = min(share, lateral / (_bend_peak(b, misses[k, 1], c0, c1) + 1e-300))
    if yaw_rate < np.inf:
        peak = _squared_peak(y, 0, misses[k, 2], c0, c1)
        share = min(share, yaw_rate * yaw_rate / (peak + 1e-300))
    return c0 * share, c1 * share


@kernel
def cell_caps(
    along: Floats,
    tangents: Floats,
    bends: Floats,
    yaws: Floats,
    misses: Floats,
    square: float,
    bound: float,
    axis_speed: Floats,
    lateral: float,
    yaw_rate: float,
) -> Floats:
    """What limits of speeds allow for v² on every cell: whatever lies below a line.

    Args:
        along: Ends of the cells [m], shape (c + 1,).
        tangents: Bernstein coefficients of T on every cell, shape (c, d, 3).
        bends: The same of K = dT/ds [1/m], shape (c, d, 3).
        yaws: The same of the change of the heading and of its change, shape (c, 2, 3), or
            (0, 2, 3) where no limit asks for them.
        misses: What these miss at most, shape (c, 4).
        square: Largest v² anywhere [m²/s²].
        bound: An acceleration along the path that no limit allows to exceed [m/s²].
        axis_speed: [m/s], shape (d,), or (0,) for no limit.
        lateral: [m/s²], inf for no limit.
        yaw_rate: [rad/s], inf for no limit.

    Returns:
        The line at both ends of each cell [m²/s²], shape (c, 2).
    """
    n, d = tangents.shape[0], tangents.shape[1]
    caps = np.empty((n, 2))
    t, b, y = np.empty((d, 3)), np.empty((d, 3)), np.zeros((1, 3))
    for k in range(n):
        for c in range(3):
            for j in range(d):
                t[j, c], b[j, c] = tangents[k, j, c], bends[k, j, c]
            if yaws.shape[0] > 0:
                y[0, c] = yaws[k, 0, c]
        h = along[k + 1] - along[k]
        caps[k, 0], caps[k, 1] = _speed_caps(
            t, b, y, misses, k, h, square, bound, axis_speed, lateral, yaw_rate
        )
    return caps


@kernel
def divide(along: Floats, marks: Floats, slip: float) -> tuple[Floats, NDArray[np.int64], Floats]:
    """Nodes at all marks and at all ends of cells between them.

    Args:
        along: Ends of the cells [m], not decreasing, shape (c + 1,).
        marks: First node, places that have to be nodes, last node [m], increasing, shape (k,).
        slip: An end of a cell that is nearer to a mark is left out [m].

    Returns:
        The nodes [m], shape (n + 1,); the cell of every stretch (n,), and which part of it the
        stretch is, in [0, 1], shape (n, 2).
    """
    c, k = along.shape[0] - 1, marks.shape[0]
    line = np.empty(c + 1 + k)
    line[0], count, j = marks[0], 1, 1
    for i in range(c + 1):
        while j < k and marks[j] <= along[i] + slip:
            line[count] = marks[j]
            count += 1
            j += 1
        if j < k and along[i] > line[count - 1] + slip and along[i] < marks[j] - slip:
            line[count] = along[i]
            count += 1
    while j < k:
        line[count] = marks[j]
        count += 1
        j += 1
    cell, ends, now = np.empty(count - 1, np.int64), np.empty((count - 1, 2)), 0
    for i in range(count - 1):
        middle = 0.5 * (line[i] + line[i + 1])
        while now < c - 1 and along[now + 1] <= middle:
            now += 1
        width = max(along[now + 1] - along[now], 1e-300)
        cell[i] = now
        ends[i, 0] = min(max((line[i] - along[now]) / width, 0.0), 1.0)
        ends[i, 1] = min(max((line[i + 1] - along[now]) / width, 0.0), 1.0)
    return line[:count], cell, ends


@kernel
def stretch_planes(
    line: Floats,
    cell: NDArray[np.int64],
    ends: Floats,
    tops: Floats,
    caps: Floats,
    tangents: Floats,
    bends: Floats,
    yaws: Floats,
    misses: Floats,
    speeds: Floats,
    accel: float,
    brake: float,
    bound: float,
    axis_accel: Floats,
    yaw_accel: float,
) -> Floats:
    """What the limits ask of v² at both ends of every stretch.

    Args:
        line: Ends of the stretches [m], increasing, shape (n + 1,).
        cell: The cell that each lies in, shape (n,).
        ends: Which part of the cell it is, in [0, 1], shape (n, 2).
        tops: Largest v² on it [m²/s²], shape (n,).
        caps: Largest v² at the nodes, shape (n + 1,); lowered in place by ``tops`` and ``speeds``.
        tangents: Bernstein coefficients of T on every cell, shape (c, d, 3).
        bends: The same of K = dT/ds [1/m], shape (c, d, 3).
        yaws: The same of the change of the heading and of its change [1/m, 1/m²], shape
            (c, 2, 3), or (0, 2, 3) where no limit asks for them.
        misses: What these miss at most: T, K, change of heading, its change, shape (c, 4).
        speeds: Of ``cell_caps``, shape (c, 2).
        accel: [m/s²].
        brake: [m/s²].
        bound: An acceleration along the path that no limit allows to exceed [m/s²].
        axis_accel: [m/s²], shape (d,), or (0,) for no limit.
        yaw_accel: [rad/s²], inf for no limit.

    Returns:
        Half-planes p w0 + q w1 <= g, shape (n, k, 3); w0 = w1 = 0 keeps them all.
    """
    n, d, axes = tops.shape[0], tangents.shape[1], axis_accel.shape[0]
    many = 2 + 8 * axes
    if yaw_accel < np.inf:
        many += 8
    planes = np.zeros((n, many, 3))
    t, b, y, z = np.empty((d, 3)), np.empty((d, 3)), np.zeros((1, 3)), np.zeros((1, 3))
    for i in range(n):
        k, h, x0, x1 = cell[i], line[i + 1] - line[i], ends[i, 0], ends[i, 1]
        for j in range(d):
            _part(tangents, k, j, x0, x1, t, j)
            _part(bends, k, j, x0, x1, b, j)
        if yaws.shape[0] > 0:
            _part(yaws, k, 0, x0, x1, y, 0)
            _part(yaws, k, 1, x0, x1, z, 0)
        for side in range(2):
            top = speeds[k, 0] + ends[i, side] * (speeds[k, 1] - speeds[k, 0])
            caps[i + side] = min(caps[i + side], top, tops[i])
        most = bound
        for j in range(axes):
            most = min(most, 0.25 * axis_accel[j] / (misses[k, 0] + 1e-300))
        if yaw_accel < np.inf:
            most = min(most, 0.25 * yaw_accel / (misses[k, 2] + 1e-300))
        planes[i, 0, 0], planes[i, 0, 1], planes[i, 0, 2] = -1.0, 1.0, 2.0 * h * min(accel, most)
        planes[i, 1, 0], planes[i, 1, 1], planes[i, 1, 2] = 1.0, -1.0, 2.0 * h * min(brake, most)
        m = 2
        for j in range(axes):
            limit = axis_accel[j] - misses[k, 0] * most
            m = _couple(t, b, j, misses[k, 1], limit, h, planes, i, m)
        if yaw_accel < np.inf:
            m = _couple(y, z, 0, misses[k, 3], yaw_accel - misses[k, 2] * most, h, planes, i, m)
    return planes


@kernel
def reachable_profile(
    line: Floats, planes: Floats, caps: Floats, brake: float, first: float
) -> tuple[Floats, float, float]:
    """The fastest v² at the nodes: controllable sets from the end, then greedily from the start.

    Every controllable set is [0, back]: a robot that stands may go on standing.

    Args:
        line: Nodes [m], increasing, shape (n + 1,).
        planes: Of ``stretch_planes``, shape (n, k, 3).
        caps: Largest v² at the nodes, 0 where the robot rests, shape (n + 1,).
        brake: With this the robot brakes while it is faster than it may be [m/s²].
        first: v² at the start.

    Returns:
        v² at the nodes; the distance up to which it is above what the limits allow (the start if
        it never is); the first place where it can't come to rest as it should (nan if none).
    """
    n, m = planes.shape[0], planes.shape[1]
    back, squares = np.empty(n + 1), np.empty(n + 1)
    back[n] = caps[n]
    for i in range(n - 1, -1, -1):
        back[i] = 0.0
        if caps[i] > 0.0:
            back[i] = _largest_first(planes, i, m, caps[i], back[i + 1]) * (1.0 - 1e-12)
    slip = 1e-12 + 1e-14 * brake * abs(line[n])
    is_over = first > back[0] * (1.0 + 1e-9) + slip + 4e-6 * brake  # 2 µm of braking
    squares[0] = first if is_over else min(first, back[0])
    over, missed = line[0], np.nan
    if is_over and caps[0] == 0.0:
        missed = line[0]
    for i in range(n):
        if not is_over:
            squares[i + 1] = _largest_second(planes, i, m, squares[i], back[i + 1])
            continue
        over = line[i + 1]
        squares[i + 1] = squares[i] - 2.0 * brake * (line[i + 1] - line[i])
        is_over = squares[i + 1] > back[i + 1] * (1.0 + 1e-9) + slip
        if not is_over:
            squares[i + 1] = back[i + 1]
        elif np.isnan(missed) and (caps[i + 1] == 0.0 or i == n - 1):
            missed = line[i + 1]
    return squares, over, missed
