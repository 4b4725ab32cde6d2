"""From via points to Bézier spans: the tangent rules of the cardinal family.

With knots ``T_0 < T_1 < ...`` a rule gives a velocity ``V_i = dP/dT`` at every via point. On span
k, whose knots are ``h_k = T_{k+1} - T_k`` apart, the tangents with respect to the local parameter
are ``h_k V_k`` and ``h_k V_{k+1}``, times the slack factor where the rule scales each span.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from viaspline.kernels.arrays import Floats
from viaspline.kernels.jit import inner, kernel


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
def parabola_bends(slopes: Floats, h: Floats, closed: bool, bends: Floats) -> None:
    """Second derivatives of the parabolas through three via points; 0 at an open end.

    ``A_i = 2 (d_i - d_{i-1}) / (h_{i-1} + h_i)`` with the slopes d: together with the velocity of
    ``cardinal_velocities`` it is the whole second-order behaviour of the parabola.

    Args:
        slopes: (p, d), p spans that have a length.
        h: Their knot distances, (p,).
        closed: Whether the last span is followed by the first; the last row repeats the first.
        bends: (p + 1, d), filled.
    """
    spans = slopes.shape[0]
    for axis in range(slopes.shape[1]):
        bends[0, axis] = 0.0
        bends[spans, axis] = 0.0
        for j in range(1, spans):
            rise = slopes[j, axis] - slopes[j - 1, axis]
            bends[j, axis] = 2.0 * rise / (h[j - 1] + h[j])
        if closed:
            rise = slopes[0, axis] - slopes[spans - 1, axis]
            bends[0, axis] = 2.0 * rise / (h[spans - 1] + h[0])
            bends[spans, axis] = bends[0, axis]


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


@inner
def three_cubics(
    start: Floats, end: Floats, v0: Floats, v1: Floats, a0: Floats, a1: Floats, polygons: Floats
) -> None:
    """Three C2 cubics with given ends: a span of continuous second derivative.

    One cubic has no room for position, velocity and second derivative at both ends; three on
    thirds of the span have just as much as that asks for. With de Boor's points D0 and D1, which
    the ends give, the two inner joints lie between their neighbours and those of the middle cubic
    at the thirds of D0 D1.

    Args:
        start: (d,).
        end: (d,).
        v0: First derivative at the start with respect to the span's local parameter, (d,).
        v1: The same at the end, (d,).
        a0: Second derivative at the start, (d,).
        a1: The same at the end, (d,).
        polygons: (3, 4, d), filled.
    """
    for axis in range(start.shape[0]):
        p1 = start[axis] + v0[axis] / 9.0
        p2 = start[axis] + v0[axis] / 4.5 + a0[axis] / 54.0
        q2 = end[axis] - v1[axis] / 9.0
        q1 = end[axis] - v1[axis] / 4.5 + a1[axis] / 54.0
        d0 = 2.0 * p2 - p1
        d1 = 2.0 * q1 - q2
        m1 = (2.0 * d0 + d1) / 3.0
        m2 = (d0 + 2.0 * d1) / 3.0
        first = 0.5 * (p2 + m1)
        last = 0.5 * (m2 + q1)
        polygons[0, 0, axis] = start[axis]
        polygons[0, 1, axis] = p1
        polygons[0, 2, axis] = p2
        polygons[0, 3, axis] = first
        polygons[1, 0, axis] = first
        polygons[1, 1, axis] = m1
        polygons[1, 2, axis] = m2
        polygons[1, 3, axis] = last
        polygons[2, 0, axis] = last
        polygons[2, 1, axis] = q1
        polygons[2, 2, axis] = q2
        polygons[2, 3, axis] = end[axis]


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
    """Spans with continuous curvature, three cubics a span; arguments as ``cardinal_spans``.

    Returns:
        Bézier control polygons, (3 m, 4, d) [m].
    """
    spacing = knot_spacing(points, knots_alpha, closed)
    kept, h, slopes = slopes_of(points, spacing)
    last = kept.shape[0] - 1
    count, dimension = points.shape
    velocities = np.empty((last + 2, dimension))
    bends = np.empty((last + 2, dimension))
    if last >= 0:
        cardinal_velocities(slopes, h, closed, velocities)
        parabola_bends(slopes, h, closed, bends)
        if has_start:
            _aim(velocities[0], start_tangent, slopes[0], 1.0)
        if has_end:
            _aim(velocities[last + 1], end_tangent, slopes[last], 1.0)
    polygons = np.empty((3 * spacing.shape[0], 4, dimension))
    for k in range(spacing.shape[0]):
        for row in range(3 * k, 3 * k + 3):
            for i in range(4):
                for axis in range(dimension):
                    polygons[row, i, axis] = points[k, axis]
    v0, v1, a0, a1 = np.empty((4, dimension))
    for j in range(last + 1):
        k = kept[j]
        gain = 2.0 * slack_per_span[k] * h[j]
        for axis in range(dimension):
            v0[axis] = gain * velocities[j, axis]
            v1[axis] = gain * velocities[j + 1, axis]
            a0[axis] = gain * gain * bends[j, axis]
            a1[axis] = gain * gain * bends[j + 1, axis]
        three_cubics(
            points[k], points[(k + 1) % count], v0, v1, a0, a1, polygons[3 * k : 3 * k + 3]
        )  # fmt: skip
    return polygons


@kernel
def flattened(span: Floats, at_start: bool, at_end: bool) -> Floats:
    """A span of three cubics that begins or ends straight: without second derivative there.

    Args:
        span: (3, 4, d), as ``three_cubics`` lays them.
        at_start: Whether it begins straight.
        at_end: Whether it ends straight.

    Returns:
        (3, 4, d), with the same places and first derivatives at both ends.
    """
    first, last = span[0], span[2]
    a0 = 54.0 * (first[2] - 2.0 * first[1] + first[0])
    a1 = 54.0 * (last[3] - 2.0 * last[2] + last[1])
    v0, v1 = 9.0 * (first[1] - first[0]), 9.0 * (last[3] - last[2])
    found = np.empty_like(span)
    three_cubics(
        first[0], last[3], v0, v1, 0.0 * a0 if at_start else a0, 0.0 * a1 if at_end else a1, found
    )
    return found
