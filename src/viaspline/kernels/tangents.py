"""From via points to Bézier spans: the tangent rules of the cardinal family.

With knots ``T_0 < T_1 < ...`` a rule gives a velocity ``V_i = dP/dT`` at every via point. On span
k, whose knots are ``h_k = T_{k+1} - T_k`` apart, the tangents with respect to the local parameter
are ``h_k V_k`` and ``h_k V_{k+1}``, times the slack factor where the rule scales each span.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.jit import kernel

Floats = NDArray[np.float64]


@kernel
def knot_spacing(points: Floats, alpha: float, closed: bool) -> Floats:
    """Distances between knots: ``|P_{k+1} - P_k| ** alpha``.

    Args:
        points: Via points, (n, d) [m].
        alpha: 0 uniform, 0.5 centripetal, 1 chordal.
        closed: Whether the last point is followed by the first.

    Returns:
        (m,), m = n - 1 spans, or n when closed. 1 everywhere when uniform; otherwise 0 between a
        point and its repetition.
    """
    count = points.shape[0]
    spans = count if closed else count - 1
    spacing = np.ones(spans)
    if alpha == 0.0:
        return spacing
    for k in range(spans):
        after = (k + 1) % count
        squared = 0.0
        for axis in range(points.shape[1]):
            step = points[after, axis] - points[k, axis]
            squared += step * step
        chord = math.sqrt(squared)
        if alpha == 1.0:
            spacing[k] = chord
        elif alpha == 0.5:
            spacing[k] = math.sqrt(chord)
        else:
            spacing[k] = chord**alpha
    return spacing


@kernel
def distinct(spacing: Floats, closed: bool) -> NDArray[np.int64]:
    """The spans that have a length, as numbers of the points that they start from.

    Args:
        spacing: Knot distances, (m,).
        closed: Whether the last span ends at the first point.

    Returns:
        (p,): spans with a spacing above 0, in order.
    """
    kept = np.empty(spacing.shape[0], np.int64)
    size = 0
    for k in range(spacing.shape[0]):
        if spacing[k] > 0.0:
            kept[size] = k
            size += 1
    return kept[:size]


@kernel
def _slopes(points: Floats, spacing: Floats, kept: NDArray[np.int64]) -> Floats:
    """Chord over knot distance of every span that has a length, (p, d)."""
    count = points.shape[0]
    slopes = np.empty((kept.shape[0], points.shape[1]))
    for j in range(kept.shape[0]):
        k = kept[j]
        for axis in range(points.shape[1]):
            slopes[j, axis] = (points[(k + 1) % count, axis] - points[k, axis]) / spacing[k]
    return slopes


@kernel
def cardinal_velocities(slopes: Floats, h: Floats, closed: bool) -> Floats:
    """Non-uniform Catmull-Rom velocities; the paper's when the knots are uniform.

    Barry and Goldman (1988): the derivative of the parabola through three via points,
    ``V_i = (h_i d_{i-1} + h_{i-1} d_i) / (h_{i-1} + h_i)`` with the slopes d. At an open end the
    end point stands twice, as far apart in the knots as the span beside it is long:
    ``V_0 = d_0 / 2``, the paper's end for all three knot rules.

    Args:
        slopes: (p, d), p spans that have a length.
        h: Their knot distances, (p,).
        closed: Whether the last span is followed by the first.

    Returns:
        (p + 1, d); closed: the last row repeats the first.
    """
    spans = slopes.shape[0]
    velocities = np.empty((spans + 1, slopes.shape[1]))
    for axis in range(slopes.shape[1]):
        for j in range(1, spans):
            weight = h[j - 1] / (h[j - 1] + h[j])
            before = slopes[j - 1, axis]
            velocities[j, axis] = before + weight * (slopes[j, axis] - before)
        if closed:
            weight = h[spans - 1] / (h[spans - 1] + h[0])
            before = slopes[spans - 1, axis]
            velocities[0, axis] = before + weight * (slopes[0, axis] - before)
            velocities[spans, axis] = velocities[0, axis]
        else:
            velocities[0, axis] = 0.5 * slopes[0, axis]
            velocities[spans, axis] = 0.5 * slopes[spans - 1, axis]
    return velocities


@kernel
def _solve(lower: Floats, upper: Floats, right: Floats) -> None:
    """Solve a tridiagonal system with ones on its diagonal, in place of its right side (n, r).

    Stable without pivoting, because ``lower[i] + upper[i] < 1`` in every row.
    """
    count, columns = right.shape
    above = np.empty(count)
    pivot = 1.0
    for i in range(count):
        if i > 0:
            pivot = 1.0 - lower[i] * above[i - 1]
        above[i] = upper[i] / pivot
        for c in range(columns):
            before = lower[i] * right[i - 1, c] if i > 0 else 0.0
            right[i, c] = (right[i, c] - before) / pivot
    for i in range(count - 2, -1, -1):
        for c in range(columns):
            right[i, c] -= above[i] * right[i + 1, c]


@kernel
def _solve_cyclic(lower: Floats, upper: Floats, right: Floats) -> None:
    """The same with ``lower[0]`` in the last column and ``upper[-1]`` in the first.

    The corners are a rank-one change of a tridiagonal matrix (Sherman and Morrison): with
    ``A = B + p q'``, p = (-1, 0, ..., 0, upper[-1]) and q = (1, 0, ..., 0, -lower[0]).
    """
    count, columns = right.shape
    corner = lower[0]
    other = upper[count - 1]
    scaled = np.zeros((count, columns + 1))
    low = lower.copy()
    up = upper.copy()
    low[0] = 0.0
    up[count - 1] = 0.0
    scaled[:, :columns] = right
    scaled[0, columns] = -1.0
    scaled[count - 1, columns] += other
    # the diagonal of B is 2, 1, ..., 1, 1 + corner * other: rows are divided by it
    last = 1.0 + corner * other
    up[0] /= 2.0
    low[count - 1] /= last
    for c in range(columns + 1):
        scaled[0, c] /= 2.0
        scaled[count - 1, c] /= last
    _solve(low, up, scaled)
    bottom = 1.0 + scaled[0, columns] - corner * scaled[count - 1, columns]
    for c in range(columns):
        factor = (scaled[0, c] - corner * scaled[count - 1, c]) / bottom
        for i in range(count):
            right[i, c] = scaled[i, c] - factor * scaled[i, columns]


@kernel
def continuous_velocities(
    slopes: Floats, h: Floats, slack: Floats, start: Floats, end: Floats, closed: bool
) -> Floats:
    """Velocities of Nielson's nu-spline: curvature is continuous at every via point.

    See ``viaspline.curve.tangents.continuous`` for the derivation.

    Args:
        slopes: (p, d), p spans that have a length.
        h: Their knot distances, (p,).
        slack: Their slack, (p,).
        start: Velocity at the start, (d,); its first number is NaN for a natural end.
        end: Velocity at the end, likewise.
        closed: Whether the last span is followed by the first.

    Returns:
        (p + 1, d); closed: the last row repeats the first.
    """
    spans, dimension = slopes.shape
    count = spans if closed else spans + 1
    lower = np.zeros(count)
    upper = np.zeros(count)
    velocities = np.empty((spans + 1, dimension))
    for i in range(count):
        before = i - 1 if i > 0 else (spans - 1 if closed else 0)
        after = i if i < spans else spans - 1
        s = 0.5 * (slack[before] + slack[after])
        gain = 2.0 * s / (1.0 + 2.0 * s)  # (1 - t) / (2 - t)
        weight = h[after] / (h[before] + h[after])
        if not closed and i == 0:
            weight = 0.0
        elif not closed and i == spans:
            weight = 1.0
        lower[i] = gain * weight
        upper[i] = gain * (1.0 - weight)
        for axis in range(dimension):
            mean = slopes[before, axis] * weight + slopes[after, axis] * (1.0 - weight)
            velocities[i, axis] = 3.0 * gain * mean
    if closed:
        _solve_cyclic(lower, upper, velocities[:count])
        velocities[spans] = velocities[0]
        return velocities
    if not math.isnan(start[0]):
        upper[0] = 0.0
        velocities[0] = start
    if not math.isnan(end[0]):
        lower[spans] = 0.0
        velocities[spans] = end
    _solve(lower, upper, velocities)
    return velocities


@kernel
def _end_velocity(direction: Floats, has: bool, slope: Floats, slack: float) -> Floats:
    """Velocity along a unit direction, ``2 s`` times as long as the slope of the end span."""
    velocity = np.full(direction.shape[0], np.nan)
    if has:
        squared = 0.0
        for axis in range(slope.shape[0]):
            squared += slope[axis] * slope[axis]
        for axis in range(slope.shape[0]):
            velocity[axis] = direction[axis] * (2.0 * slack * math.sqrt(squared))
    return velocity


@kernel
def _spans_of(
    points: Floats,
    alpha: float,
    slack: Floats,
    start: Floats,
    end: Floats,
    has_start: bool,
    has_end: bool,
    closed: bool,
    continuous: bool,
) -> Floats:
    """Spans through the points by either rule."""
    count, dimension = points.shape
    spacing = knot_spacing(points, alpha, closed)
    spans = np.empty((spacing.shape[0], 4, dimension))
    for k in range(spans.shape[0]):  # a repeated point: all four control points are the same
        for axis in range(dimension):
            spans[k, 0, axis] = points[k, axis]
            spans[k, 1, axis] = points[k, axis]
            spans[k, 2, axis] = points[(k + 1) % count, axis]
            spans[k, 3, axis] = points[(k + 1) % count, axis]
    kept = distinct(spacing, closed)
    last = kept.shape[0] - 1
    if last < 0:
        return spans
    slopes = _slopes(points, spacing, kept)
    h = spacing[kept]
    s = slack[kept]
    first_velocity = _end_velocity(start, has_start, slopes[0], s[0])
    last_velocity = _end_velocity(end, has_end, slopes[last], s[last])
    if continuous:
        velocities = continuous_velocities(slopes, h, s, first_velocity, last_velocity, closed)
    else:
        velocities = cardinal_velocities(slopes, h, closed)
    for j in range(last + 1):
        k = kept[j]
        scale = h[j] / 3.0 if continuous else 2.0 * s[j] * h[j] / 3.0
        for axis in range(dimension):
            spans[k, 1, axis] += scale * velocities[j, axis]
            spans[k, 2, axis] -= scale * velocities[j + 1, axis]
    if has_start and not closed:
        for axis in range(dimension):
            k = kept[0]
            spans[k, 1, axis] = spans[k, 0, axis] + h[0] / 3.0 * first_velocity[axis]
    if has_end and not closed:
        for axis in range(dimension):
            k = kept[last]
            spans[k, 2, axis] = spans[k, 3, axis] - h[last] / 3.0 * last_velocity[axis]
    return spans


@kernel
def cardinal_spans(
    points: Floats,
    knots_alpha: float,
    slack_per_span: Floats,
    start_tangent: Floats,
    end_tangent: Floats,
    has_start: bool,
    has_end: bool,
    closed: bool,
) -> Floats:
    """The cardinal spline through via points as Bézier spans.

    Args:
        points: Via points, (n, d) [m], n >= 2.
        knots_alpha: 0 uniform, 0.5 centripetal, 1 chordal.
        slack_per_span: s = (1 - tension) / 2, (m,), m = n - 1 spans, or n when closed.
        start_tangent: Unit direction at the start, (d,); counts when ``has_start``.
        end_tangent: Unit direction at the end, (d,); counts when ``has_end``.
        has_start: Whether the start's direction is given.
        has_end: Whether the end's direction is given.
        closed: Whether the last point is followed by the first; no directions then.

    Returns:
        Bézier control polygons, (m, 4, d) [m].
    """
    return _spans_of(
        points, knots_alpha, slack_per_span, start_tangent, end_tangent,
        has_start, has_end, closed, False,
    )  # fmt: skip


@kernel
def continuous_spans(
    points: Floats,
    knots_alpha: float,
    slack_per_span: Floats,
    start_tangent: Floats,
    end_tangent: Floats,
    has_start: bool,
    has_end: bool,
    closed: bool,
) -> Floats:
    """The same through velocities that make curvature continuous; see ``cardinal_spans``."""
    return _spans_of(
        points, knots_alpha, slack_per_span, start_tangent, end_tangent,
        has_start, has_end, closed, True,
    )  # fmt: skip
