"""The tangent rules of the cardinal family, as pure functions from via points to spans.

All of them take the same arguments, give the same velocities at the via points, and reduce to the
polyline at slack 0.
"""

from __future__ import annotations

from collections.abc import Callable
from types import MappingProxyType

from viaspline.kernels.arrays import Floats
from viaspline.kernels.curve import cardinal_tangents as kernels

Rule = Callable[[Floats, float, Floats, Floats, Floats, bool, bool, bool], Floats]

ALPHA = MappingProxyType({"uniform": 0.0, "centripetal": 0.5, "chordal": 1.0})


def cardinal(
    points: Floats,
    alpha: float,
    slack: Floats,
    start: Floats,
    end: Floats,
    has_start: bool,
    has_end: bool,
    closed: bool,
) -> Floats:
    r"""Tangents along the neighbours: the paper's cardinal spline, for any knots.

    With knot distances :math:`h_k = |P_{k+1} - P_k|^\alpha` and slopes
    :math:`d_k = (P_{k+1} - P_k) / h_k` the velocity is that of the parabola through three points,
    :math:`V_i = (h_i d_{i-1} + h_{i-1} d_i) / (h_{i-1} + h_i)`, and the tangents of span k are
    :math:`2 s_k h_k V_k` and :math:`2 s_k h_k V_{k+1}`. With uniform knots they are
    :math:`s (P_{i+1} - P_{i-1})`: the matrix :math:`M_c`.

    An open end repeats its point, which makes the tangent :math:`s_0 (P_1 - P_0)`. A given
    direction e replaces the repeated point by :math:`P_1 - 2 |P_1 - P_0| e`: the tangent is
    :math:`2 s_0 |P_1 - P_0| e`, whatever the knots.

    Source: E. Catmull and R. Rom, A class of local interpolating splines (1974); P. J. Barry and
    R. N. Goldman, A recursive evaluation algorithm for a class of Catmull-Rom splines (1988).

    Args:
        points: Via points [m], (n, d), n >= 2.
        alpha: 0 uniform, 0.5 centripetal, 1 chordal.
        slack: Of each span, s = (1 - tension) / 2, (m,).
        start: Unit direction at the start, (d,).
        end: Unit direction at the end, (d,).
        has_start: Whether ``start`` counts.
        has_end: Whether ``end`` counts.
        closed: Whether the last point is followed by the first.

    Returns:
        Bézier control polygons [m], (m, 4, d).
    """
    return kernels.cardinal_spans(
        points, alpha, slack, start, end, has_start, has_end, closed
    )  # fmt: skip


def continuous(
    points: Floats,
    alpha: float,
    slack: Floats,
    start: Floats,
    end: Floats,
    has_start: bool,
    has_end: bool,
    closed: bool,
) -> Floats:
    r"""Cardinal tangents, and the parabola's curvature: three C2 cubics a span.

    The velocities are those of ``cardinal``. The second derivative at a via point is that of the
    same parabola, :math:`A_i = 2 (d_i - d_{i-1}) / (h_{i-1} + h_i)`, times :math:`(2 s_k)^2` on
    span k, as the velocity is taken times :math:`2 s_k`. So the curvature at a via point,
    :math:`|V_i \times A_i| / |V_i|^3`, is the parabola's on both sides whatever the tensions:
    it is continuous there, and it stays as it is when a span is pulled taut. In between, three
    cubics on thirds of the span's knots take over position, velocity and second derivative from
    both ends, which one cubic has no room for; they are C2, and the only ones.

    The rule is as local as the cardinal one: moving a via point changes the two spans on either
    side of it. An open end has curvature 0, with a given direction as well.

    Source: quintic spans with second derivatives taken from the neighbours are due to C. Sprunk,
    Planning Motion Trajectories for Mobile Robots Using Splines (2008); here the spans stay
    cubic, and the second derivative is the one that belongs to the cardinal tangent.

    Args:
        points: Via points [m], (n, d), n >= 2.
        alpha: 0 uniform, 0.5 centripetal, 1 chordal.
        slack: Of each span, s = (1 - tension) / 2, (m,).
        start: Unit direction at the start, (d,).
        end: Unit direction at the end, (d,).
        has_start: Whether ``start`` counts.
        has_end: Whether ``end`` counts.
        closed: Whether the last point is followed by the first.

    Returns:
        Bézier control polygons [m], (3 m, 4, d).
    """
    return kernels.continuous_spans(
        points, alpha, slack, start, end, has_start, has_end, closed
    )  # fmt: skip


RULES: MappingProxyType[str, Rule] = MappingProxyType(
    {"cardinal": cardinal, "continuous": continuous}
)

PIECES: MappingProxyType[str, int] = MappingProxyType({"cardinal": 1, "continuous": 3})
"""Cubics of each rule from one via point to the next."""
