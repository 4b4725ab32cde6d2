"""How far an upright cylinder is from a product of a planar set and an interval of heights.

With a the distance in plan less the cylinder's radius and b the gap in height less its half
height, that is hypot(a, b) where both are positive, and the larger of the two elsewhere. Both are
convex along a straight line if the planar set is, and so is the square of the distance: Newton's
method with a bracket finds its minimum, and a tangent says how far below it can't be.

Tested through ``kernels/space/test_product_distance``.
"""

from __future__ import annotations

import math

from viaspline.kernels.jit import inlined, uncounted

MAX_STEPS = 48  # of Newton's method or of bisection
ACCURACY_M = 1e-9  # of a chord's distance [m]


@inlined
def combined(a: float, b: float) -> float:
    """Signed distance of a product from its signed distances in plan and in height [m]."""
    if a <= 0.0 or b <= 0.0:
        return max(a, b)
    return math.sqrt(a * a + b * b)


@inlined
def rectangle_signed(x: float, y: float, x0: float, y0: float, x1: float, y1: float) -> float:
    """Signed distance from (x, y) to a rectangle."""
    a = max(x0 - x, x - x1)
    b = max(y0 - y, y - y1)
    if a <= 0.0 or b <= 0.0:
        return max(a, b)
    return math.sqrt(a * a + b * b)


@inlined
def _square(
    x: float, y: float, z: float, dx: float, dy: float, dz: float, x0: float, y0: float, x1: float,
    y1: float, low: float, high: float, radius: float,
) -> tuple[float, float, float]:  # fmt: skip
    """Squared distance at a place that moves by (dx, dy, dz), half its slope and half its bend."""
    px = x - x0 if x < x0 else (x - x1 if x > x1 else 0.0)
    py = y - y0 if y < y0 else (y - y1 if y > y1 else 0.0)
    pz = z - low if z < low else (z - high if z > high else 0.0)
    value = pz * pz
    slope = pz * dz
    bend = dz * dz if pz != 0.0 else 0.0
    squared = px * px + py * py
    if squared > radius * radius:
        rho = math.sqrt(squared)
        share = 1.0 - radius / rho
        towards = px * dx + py * dy
        along = towards * towards / squared
        value += (rho - radius) * (rho - radius)
        slope += share * towards
        bend += along
        if px != 0.0 and py != 0.0:
            bend += share * (dx * dx + dy * dy - along)
    return value, slope, bend


@uncounted
def chord_product(
    ax: float, ay: float, az: float, dx: float, dy: float, dz: float, x0: float, y0: float,
    x1: float, y1: float, low: float, high: float, radius: float, limit: float,
) -> float:  # fmt: skip
    """Distance between a chord and a rectangle, grown by a radius in plan, times an interval [m].

    Args:
        ax: Where the chord begins [m].
        ay: Where it begins [m].
        az: Where it begins [m].
        dx: From there to its end [m].
        dy: From there to its end [m].
        dz: From there to its end [m].
        x0: The rectangle's least x [m]; it may be a line or a point.
        y0: Its least y [m].
        x1: Its greatest x [m].
        y1: Its greatest y [m].
        low: The interval's least height [m], or -inf.
        high: Its greatest [m], or inf.
        radius: By how much the rectangle is grown [m].
        limit: What is farther away need not be looked at [m].

    Returns:
        Never above the true distance and within a nanometre of it, 0 where they touch; the limit
        where it is not nearer.
    """
    if limit <= 0.0:
        return limit
    enough = limit * limit
    f0, g0, _ = _square(ax, ay, az, dx, dy, dz, x0, y0, x1, y1, low, high, radius)
    if g0 >= 0.0:
        return math.sqrt(f0) if f0 < enough else limit
    f1, g1, _ = _square(ax + dx, ay + dy, az + dz, dx, dy, dz, x0, y0, x1, y1, low, high, radius)
    if g1 <= 0.0:
        return math.sqrt(f1) if f1 < enough else limit
    early, late = 0.0, 1.0
    t = min(max((0.5 * (f1 - f0) - g1) / (g0 - g1), 0.0), 1.0)  # where the end tangents meet
    if f0 + 2.0 * g0 * t >= enough:
        return limit
    least = 0.0
    before = 1.0
    for _ in range(MAX_STEPS):
        f, g, k = _square(
            ax + t * dx, ay + t * dy, az + t * dz, dx, dy, dz, x0, y0, x1, y1, low, high, radius
        )
        if g < 0.0:
            gap = -2.0 * g * (late - t)
            early = t
        else:
            gap = 2.0 * g * (t - early)
            late = t
        least = max(least, f - gap)
        if least >= enough:
            return limit
        if f <= ACCURACY_M * ACCURACY_M:
            return 0.0
        if gap <= ACCURACY_M * math.sqrt(f):
            return math.sqrt(least)
        after = t - g / k if k > 0.0 else -1.0
        if not early < after < late or abs(after - t) > 0.5 * before:
            after = 0.5 * (early + late)
        before = abs(after - t)
        t = after
    return math.sqrt(least)
