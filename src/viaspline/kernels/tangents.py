"""From via points to Bézier spans: the tangent rules of the cardinal family.

With knots ``T_0 < T_1 < ...`` a rule gives a velocity ``V_i = dP/dT`` at every via point. On span
k, whose knots are ``h_k = T_{k+1} - T_k`` apart, the tangents with respect to the local parameter
are ``h_k V_k`` and ``h_k V_{k+1}``, times the slack factor where the rule scales each span.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.jit import inner, kernel

Floats = NDArray[np.float64]


@kernel
def knot_spacing(points: Floats, alpha: float, closed: bool) -> Floats:
    """Distances between knots: ``|P_{k+1} - P_k| ** alpha``.

    Args:
        points: Via points, (n, d) [m].
        alpha: 0 uniform, 0.5 centripetal, 1 chordal.
        closed: Whether the last point is followed by the first.

    Returns:
        (m,), m = n - 1, or n when closed; 0 at a repeated point, unless uniform.
    """
    count = points.shape[0]
    spans = count if closed else count - 1
    spacing = np.ones(spans)
    if alpha == 0.0:
        return spacing
    for k in range(spans):
        squared = 0.0
        for axis in range(points.shape[1]):
            step = points[(k + 1) % count, axis] - points[k, axis]
            squared += step * step
        chord = math.sqrt(squared)
        spacing[k] = chord if alpha == 1.0 else chord**alpha
    return spacing


@kernel
def slopes_of(points: Floats, spacing: Floats) -> tuple[NDArray[np.int64], Floats, Floats]:
    """The spans that have a length: their numbers (p,), knot distances (p,) and slopes (p, d).

    A slope is chord over knot distance; ``spacing`` (m,) is that of ``knot_spacing``.
    """
    count, dimension = points.shape
    kept = np.empty(spacing.shape[0], np.int64)
    h = np.empty(spacing.shape[0])
    slopes = np.empty((spacing.shape[0], dimension))
    size = 0
    for k in range(spacing.shape[0]):
        if spacing[k] > 0.0:
            kept[size] = k
            h[size] = spacing[k]
            for axis in range(dimension):
                chord = points[(k + 1) % count, axis] - points[k, axis]
                slopes[size, axis] = chord / spacing[k]
            size += 1
    return kept[:size], h[:size], slopes[:size]


@inner
def cardinal_velocities(slopes: Floats, h: Floats, closed: bool, velocities: Floats) -> None:
    """Non-uniform Catmull-Rom velocities; the paper's when the knots are uniform.

    Barry and Goldman (1988): the derivative of the parabola through three via points,
    ``V_i = (h_i d_{i-1} + h_{i-1} d_i) / (h_{i-1} + h_i)`` with the slopes d. At an open end the
    end point stands twice, as far apart in the knots as the span beside it is long:
    ``V_0 = d_0 / 2``, the paper's end for all three knot rules.

    Args:
        slopes: (p, d), p spans that have a length.
        h: Their knot distances, (p,).
        closed: Whether the last span is followed by the first; the last row repeats the first.
        velocities: (p + 1, d), filled.
    """
    spans = slopes.shape[0]
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


@inner
def _solve(lower: Floats, upper: Floats, right: Floats) -> None:
    """Solve a tridiagonal system with ones on its diagonal, in place of its right side (n, r).

    Stable without pivoting, because ``lower[i] + upper[i] < 1`` in every row.
    """
    count, columns = right.shape
    above = np.empty(count)
    above[0] = upper[0]
    for i in range(1, count):
        pivot = 1.0 - lower[i] * above[i - 1]
        above[i] = upper[i] / pivot
        for c in range(columns):
            right[i, c] = (right[i, c] - lower[i] * right[i - 1, c]) / pivot
    for i in range(count - 2, -1, -1):
        for c in range(columns):
            right[i, c] -= above[i] * right[i + 1, c]


@inner
def _solve_cyclic(lower: Floats, upper: Floats, right: Floats) -> None:
    """The same with ``lower[0]`` in the last column and ``upper[-1]`` in the first.

    Sherman and Morrison: A = B + p q', B tridiagonal, p = (-1, 0, ..., 0, upper[-1]) and
    q = (1, 0, ..., 0, -lower[0]). ``right`` (n, r + 1) has room for p; the rest is used up.
    """
    count, columns = right.shape
    last = count - 1
    corner = lower[0]
    for i in range(count):
        right[i, columns - 1] = 0.0
    right[0, columns - 1] = -1.0
    right[last, columns - 1] += upper[last]
    # the diagonal of B is 2, 1, ..., 1, 1 + product of the corners: its rows are divided by it
    scale = 1.0 + corner * upper[last]
    upper[0] /= 2.0
    lower[last] /= scale
    for c in range(columns):
        right[0, c] /= 2.0
        right[last, c] /= scale
    _solve(lower, upper, right)
    bottom = 1.0 + right[0, columns - 1] - corner * right[last, columns - 1]
    for c in range(columns - 1):
        factor = (right[0, c] - corner * right[last, c]) / bottom
        for i in range(count):
            right[i, c] -= factor * right[i, columns - 1]


@inner
def continuous_velocities(
    slopes: Floats, h: Floats, slack: Floats, velocities: Floats, fixed: int, closed: bool
) -> None:
    """Velocities of Nielson's nu-spline: curvature is continuous at every via point.

    See ``viaspline.curve.tangents.continuous`` for the derivation.

    Args:
        slopes: (p, d), p spans that have a length.
        h: Their knot distances, (p,).
        slack: Their slack, (p,).
        velocities: (p + 1, d + 1), filled but for the last column, which is scratch. Where the
            first or last row is fixed, it holds the velocity already.
        fixed: 1 when the first row is fixed, 2 when the last one is, 3 when both are.
        closed: Whether the last span is followed by the first; the last row repeats the first.
    """
    spans, dimension = slopes.shape
    count = spans if closed else spans + 1
    lower = np.empty(count)
    upper = np.empty(count)
    for i in range(spans + 1):
        velocities[i, dimension] = 0.0
    for i in range(count):
        before = max(i - 1, 0) if i > 0 or not closed else spans - 1
        after = min(i, spans - 1)
        s = 0.5 * (slack[before] + slack[after])
        gain = 2.0 * s / (1.0 + 2.0 * s)  # (1 - t) / (2 - t)
        weight = h[after] / (h[before] + h[after])
        if not closed and (i == 0 or i == spans):
            weight = 0.0 if i == 0 else 1.0
            if fixed & (1 if i == 0 else 2):
                lower[i] = 0.0
                upper[i] = 0.0
                continue
        lower[i] = gain * weight
        upper[i] = gain * (1.0 - weight)
        for axis in range(dimension):
            mean = slopes[before, axis] * weight + slopes[after, axis] * (1.0 - weight)
            velocities[i, axis] = 3.0 * gain * mean
    if closed:
        _solve_cyclic(lower, upper, velocities[:count])
        for axis in range(dimension):
            velocities[spans, axis] = velocities[0, axis]
    else:
        _solve(lower, upper, velocities)


@inner
def _aim(velocity: Floats, direction: Floats, slope: Floats, factor: float) -> None:
    """Set a velocity along a unit direction, ``factor`` times as long as a slope."""
    squared = 0.0
    for axis in range(slope.shape[0]):
        squared += slope[axis] * slope[axis]
    for axis in range(slope.shape[0]):
        velocity[axis] = direction[axis] * (factor * math.sqrt(squared))


@inner
def _assemble(
    points: Floats, spans: int, kept: NDArray[np.int64], gain: Floats, velocities: Floats
) -> Floats:
    """Bézier spans from velocities; the tangents of kept span j are ``gain[j]`` times them."""
    count, dimension = points.shape
    polygons = np.empty((spans, 4, dimension))
    for k in range(spans):
        for axis in range(dimension):
            start = points[k, axis]
            end = points[(k + 1) % count, axis]
            polygons[k, 0, axis] = start
            polygons[k, 1, axis] = start
            polygons[k, 2, axis] = end
            polygons[k, 3, axis] = end
    for j in range(kept.shape[0]):
        k = kept[j]
        for axis in range(dimension):
            polygons[k, 1, axis] += gain[j] / 3.0 * velocities[j, axis]
            polygons[k, 2, axis] -= gain[j] / 3.0 * velocities[j + 1, axis]
    return polygons


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
        has_start: Whether the start's direction is given; not when closed.
        has_end: Whether the end's direction is given; not when closed.
        closed: Whether the last point is followed by the first.

    Returns:
        Bézier control polygons, (m, 4, d) [m].
    """
    spacing = knot_spacing(points, knots_alpha, closed)
    kept, h, slopes = slopes_of(points, spacing)
    last = kept.shape[0] - 1
    velocities = np.empty((last + 2, points.shape[1]))
    if last >= 0:
        cardinal_velocities(slopes, h, closed, velocities)
        if has_start:
            _aim(velocities[0], start_tangent, slopes[0], 1.0)
        if has_end:
            _aim(velocities[last + 1], end_tangent, slopes[last], 1.0)
    for j in range(last + 1):
        h[j] *= 2.0 * slack_per_span[kept[j]]
    return _assemble(points, spacing.shape[0], kept, h, velocities)


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
    """The same by velocities that make curvature continuous; arguments as ``cardinal_spans``."""
    spacing = knot_spacing(points, knots_alpha, closed)
    kept, h, slopes = slopes_of(points, spacing)
    last = kept.shape[0] - 1
    velocities = np.empty((last + 2, points.shape[1] + 1))
    slack = np.empty(last + 1)
    for j in range(last + 1):
        slack[j] = slack_per_span[kept[j]]
    if last >= 0:
        fixed = 0
        if has_start:
            fixed += 1
            _aim(velocities[0], start_tangent, slopes[0], 2.0 * slack[0])
        if has_end:
            fixed += 2
            _aim(velocities[last + 1], end_tangent, slopes[last], 2.0 * slack[last])
        continuous_velocities(slopes, h, slack, velocities, fixed, closed)
    return _assemble(points, spacing.shape[0], kept, h, velocities)
