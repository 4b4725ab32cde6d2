"""The tangent rules of the cardinal family, as pure functions from via points to spans.

A rule decides only the velocity at each via point; what follows is the same piecewise cubic. All
of them take the same arguments, and reduce to the polyline at slack 0.
"""

from __future__ import annotations

from collections.abc import Callable
from types import MappingProxyType

from viaspline.curve.arguments import Floats
from viaspline.kernels import tangents as kernels

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
    r"""Tangents that make curvature continuous: Nielson's nu-spline.

    Curvature is :math:`|P' \times P''| / |P'|^3`. P' is continuous, so curvature is as well when
    the jump of P'' points along P': :math:`P''(T_i^+) - P''(T_i^-) = \nu_i P'(T_i)`. On a cubic
    with end velocities V and slope d,

    .. math:: P''(T_i^+) = (6 d_i - 4 V_i - 2 V_{i+1}) / h_i, \quad
              P''(T_i^-) = (2 V_{i-1} + 4 V_i - 6 d_{i-1}) / h_{i-1}.

    Half the condition, times :math:`h_{i-1} h_i / (h_{i-1} + h_i)`, with
    :math:`a_i = h_i / (h_{i-1} + h_i)`:

    .. math:: a_i V_{i-1} + f_i V_i + (1 - a_i) V_{i+1}
              = 3 (a_i d_{i-1} + (1 - a_i) d_i), \quad
              f_i = 2 + \frac{\nu_i}{2} \frac{h_{i-1} h_i}{h_{i-1} + h_i}.

    Tension t at a via point (the mean of its two spans) means :math:`f = (2 - t) / (1 - t)`:
    :math:`\nu = 0` and the C2 cubic spline at t = 0, the polyline at t = 1, and a factor above 1
    for every t below, so that the system is always diagonally dominant. It is solved divided by
    f, with :math:`1/f = 2 s / (1 + 2 s)`, so that t = 1 is no special case.

    An open end has curvature 0: :math:`f V_0 + V_1 = 3 d_0`, the natural end at t = 0. A given
    direction fixes the end's velocity as in ``cardinal``. Other than there, moving one point
    moves the whole curve, less and less away from it.

    Source: G. M. Nielson, Some piecewise polynomial alternatives to splines under tension (1974).

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
    return kernels.continuous_spans(
        points, alpha, slack, start, end, has_start, has_end, closed
    )  # fmt: skip


RULES: MappingProxyType[str, Rule] = MappingProxyType(
    {"cardinal": cardinal, "continuous": continuous}
)
