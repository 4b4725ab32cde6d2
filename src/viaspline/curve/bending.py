"""What is proven of how a curve bends: its largest curvature, its corners, its loops."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.errors import GeometryError
from viaspline.kernels.curve import curvature_bound as kernels
from viaspline.kernels.curve import self_intersection

MOST_ROUNDED_RAD = 1e-3  # a tangent that is rounded by more is too short to have a direction [rad]
SMOOTH_JUMP_RAD = 1e-7  # a tangent that jumps by less is smooth but for rounding [rad]


def curvature_bound(curve: PiecewiseCubic, least: float = 0.0) -> tuple[float, float]:
    """A proven upper bound of the curvature of the whole curve, without its sign.

    By branch and bound on Bernstein coefficients, not by samples. Turning circles need it: a
    curve with this bound never asks for a smaller one than 1 / bound.

    Args:
        curve: Any piecewise cubic.
        least: Curvature below which nobody needs to know more, which is sooner known [1/m].

    Returns:
        (bound [1/m], u): no place bends more; at u the curve bends as much, to a millionth, unless
        the bound is ``least``.
        Infinite at a corner, where the tangent jumps by more than rounding, and at a cusp.

    Example:
        >>> curve = PiecewiseCubic([[(0, 0), (1, 2), (2, 2), (3, 0)]])
        >>> bound, u = curvature_bound(curve)
        >>> round(bound, 5), u
        (1.33333, 0.5)
        >>> curvature_bound(PiecewiseCubic([[(0, 0), (1, 0), (2, 0), (3, 0)],
        ...                                 [(3, 0), (3, 1), (3, 2), (3, 3)]]))
        (inf, 1.0)
    """
    jumps = corner_angles(curve)
    sharp = np.flatnonzero(jumps > SMOOTH_JUMP_RAD)
    if sharp.size:
        sharp = sharp[jumps[sharp] > SMOOTH_JUMP_RAD + _rounded_by(curve)[sharp]]
    if sharp.size:
        return math.inf, float(sharp[0])
    upper, _, w = kernels.curvature_bounds(np.array(curve.spans), least)
    span = int(np.argmax(upper))
    return float(upper[span]), float(span + w[span])


def is_round(curve: PiecewiseCubic, radius: float) -> bool:
    """Whether a curve is proven to bend nowhere more sharply than a circle; no corner is round.

    Args:
        curve: Any piecewise cubic.
        radius: Of the circle [m]; without one only corners and cusps are too sharp.

    Example:
        >>> bend = PiecewiseCubic([[(0, 0), (1, 2), (2, 2), (3, 0)]])
        >>> [is_round(bend, radius) for radius in (0.0, 0.74, 0.76)]
        [True, True, False]
    """
    if not radius > 0.0:
        return math.isfinite(curvature_bound(curve)[0])
    return curvature_bound(curve, 1.0 / radius)[0] <= 1.0 / radius


def corner_angles(curve: PiecewiseCubic) -> NDArray[np.float64]:
    """The angles by which the tangent jumps at the joints [rad], shape (m + 1,), in [0, pi].

    Joint 0 first; 0 at the ends of an open curve, the seam of a closed one stands at both ends.

    Example:
        >>> from viaspline.curve.cardinal import CardinalSpline
        >>> corner_angles(CardinalSpline([(0, 0), (1, 0), (1, 1)], tension=1.0)).round(4)
        array([0. , 1.5708, 0. ])
    """
    angles: NDArray[np.float64] = kernels.corners(np.array(curve.spans), curve.closed)
    return angles


def _rounded_by(curve: PiecewiseCubic) -> NDArray[np.float64]:
    """By how much tangents at joints may differ because places are rounded [rad], (m + 1,).

    In UTM the last digit of a place is a millionth of a millimetre, which turns a tangent that is a
    centimetre long by as much as is smooth otherwise.
    """
    spans = np.asarray(curve.spans)
    legs = np.linalg.norm(np.diff(spans, axis=1), axis=2)
    first, last = (np.where(a > 0.0, a, np.where(b > 0.0, b, c))
                   for a, b, c in (legs.T, legs.T[::-1]))  # fmt: skip
    off = 2.0 * np.spacing(np.abs(spans).max())
    begins, ends = (np.divide(off, leg, out=np.zeros_like(leg), where=leg > 0.0)
                    for leg in (first, last))  # fmt: skip
    seam = begins[:1] + ends[-1:] if curve.closed else np.zeros(1)
    rounded: NDArray[np.float64] = np.concatenate((seam, begins[1:] + ends[:-1], seam))
    return rounded.clip(max=MOST_ROUNDED_RAD)


def self_loops(spans: ArrayLike) -> NDArray[np.bool_]:
    """Which spans loop back on themselves.

    A span does that crosses itself, has a cusp, turns back on a straight line, or whose headings
    lie more than half a turn apart.

    Args:
        spans: Bézier control polygons [m], (m, 4, d), d at least 2; of spans in space, the ground
            track counts.

    Returns:
        Shape (m,).

    Raises:
        GeometryError: For other shapes.

    Example:
        >>> self_loops([[(0, 0), (9, 9), (-6, 9), (3, 0)], [(3, 0), (4, 0), (5, 0), (6, 0)]])
        array([ True, False])
    """
    control = np.array(spans, np.float64)
    if control.ndim != 3 or control.shape[1] != 4 or control.shape[2] < 2:
        raise GeometryError(f"spans have to be of shape (m, 4, d), d > 1, not {control.shape}")
    found: NDArray[np.bool_] = self_intersection.self_loops(control)
    return found
