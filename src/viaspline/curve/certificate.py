"""The clearance certificate: a proven lower bound over the whole continuous curve."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike

from viaspline.curve.piecewise import PiecewiseCubic
from viaspline.curve.provable_curve import StatedCurve, provable_curve
from viaspline.errors import GeometryError, with_article
from viaspline.handed_in import check_answers, room_from
from viaspline.kernels.clearance.disc import STILL, tightest
from viaspline.kernels.clearance.world_protocol import dimension
from viaspline.presentable.told_in_lines import told_in_lines
from viaspline.world.outline import outline

PROOF_TOLERANCE_M = 1e-3  # between the proven bound and the true clearance [m]
PROOF_SLACK_M = 1e-6  # what a proof may lack of what is required: a curve that just touches it [m]


@told_in_lines
@dataclass(frozen=True)
class Certificate:
    """What is proven of a curve's clearance.

    Attributes:
        clearance: Proven lower bound of the distance between the robot's body and every obstacle
            and the bounds [m]; never above the true one, and within 1 mm of it (less exact where
            a curve runs for kilometres inside of something). Infinite when there is nothing to
            keep clear of.
        required: The clearance that was asked for [m].
        tightest_at: Where it is tightest [m], shape (d,).
        tightest_u: At which parameter of the curve that is.
        tightest_distance: The same as a distance along the curve [m].
        obstacle: The name of the obstacle that is nearest there; None when there is none.
        contact: The point of a polygonal body that is nearest to it then [m]; None for a disc.
        tightest_heading: The heading of a polygonal body then [rad], which is that of the curve
            except in a turn on the spot; None for a disc.
    """

    clearance: float
    required: float
    tightest_at: tuple[float, ...]
    tightest_u: float
    tightest_distance: float
    obstacle: str | None
    contact: tuple[float, float] | None = None
    tightest_heading: float | None = None

    @property
    def holds(self) -> bool:
        """Whether the proven clearance is the one that was asked for, to a micrometre."""
        return self.clearance >= self.required - PROOF_SLACK_M


class Surroundings(Protocol):
    """What a certificate needs of a world: its packed form, and what an index is called.

    The planar ``World`` is one. Another kind is another packed type; see
    ``kernels.clearance.world_protocol``.
    """

    @property
    def packed(self) -> Any:
        """The NamedTuple of arrays that kernels take."""

    def name(self, index: int) -> str:
        """What an index of what is nearest is called."""


class _Bounds(NamedTuple):
    """What a kernel knows of the smallest distance: bounds [m], where, and what is nearest."""

    lower: float
    upper: float
    span: int
    w: float
    nearest: int
    contact: tuple[float, float, float] | None = None


def certify(
    curve: PiecewiseCubic | StatedCurve | Any,
    world: Surroundings,
    clearance: float,
    *,
    radius: float = 0.0,
    footprint: ArrayLike | None = None,
) -> Certificate:
    """Prove how far the body stays from everything in the world along the whole continuous curve.

    Pieces of the curve are bounded by their control polygons and halved until the bound is within
    a millimetre of a distance that is really attained: conservative advancement, with a
    second-order step beside obstacles.

    A footprint moves with its x axis along the tangent. Where the tangent jumps (a corner of a
    polyline, the seam of a closed curve) it turns on the spot, the short way; where the curve
    turns back, either way round is proven. Where a body overlaps something the clearance is
    negative: how deep its outline gets, to a quarter.

    Args:
        curve: Any piecewise cubic, or what has its ``spans``; a ``PPoly`` (``CubicSpline`` is one),
            ``BPoly`` or ``BSpline`` of scipy with values of d coordinates, of any degree; or any
            other curve with ``domain`` and ``evaluate``, as ``retime`` takes it, that states how
            much it bends by ``second_derivative_bound(u0, u1)``: see
            ``viaspline.curve.provable_curve``. What a curve may be off the cubics that it is
            proven by is taken off its clearance: 0.1 µm for polynomials above the third degree,
            0.1 mm for curves that state a bound, as far as 200,000 chords go. Of a curve in space,
            its ground track counts in a planar world.
        world: The obstacles and bounds: a ``World``, a ``SpatialWorld``, or another kind with a
            packed form.
        clearance: What is to be kept free between the body and everything [m].
        radius: The robot's body, a disc [m]; what a footprint is grown by.
        footprint: The robot's body, a polygon in its own frame, x forward and y left, (k, 2) [m];
            see ``viaspline.world.outline``.

    Returns:
        A certificate, whether it holds or not: see ``Certificate.holds``.

    Raises:
        GeometryError: When only values of the curve are known, or it bends more than it says; when
            it is not in the plane or in space, or the world is in space and the curve isn't; when
            there is a footprint, and the curve's tangents aren't those of the cubics it is proven
            by; when clearance or radius is not a finite number, or below 0, or the
            footprint is no polygon
            about the reference point, or the world isn't in the plane.

    Example:
        >>> from viaspline.curve.cardinal import CardinalSpline
        >>> from viaspline.mission.shapes.obstacle import Obstacle
        >>> from viaspline.world.world import World
        >>> world = World([Obstacle(circle={"center": (5, 3), "radius": 1})])
        >>> curve = CardinalSpline([(0, 0), (5, 0), (10, 0)])
        >>> certificate = certify(curve, world, 1.0, radius=0.5)
        >>> round(certificate.clearance, 3), certificate.tightest_at, certificate.holds
        (1.5, (5.0, 0.0), True)
        >>> body = [(-1, -0.5), (3, -0.5), (3, 0.5), (-1, 0.5)]
        >>> round(certify(curve, world, 1.0, footprint=body).clearance, 2)
        1.5
    """
    clearance, radius = room_from(clearance, radius)
    return certified(curve, world, clearance, radius, footprint)


def certified(
    curve: PiecewiseCubic | StatedCurve | Any,
    world: Surroundings,
    clearance: float,
    radius: float,
    footprint: ArrayLike | None,
) -> Certificate:
    """See ``certify``; for robots that stand nearer to something than they should as well.

    Args:
        curve: See there, and the others.
        world: Likewise.
        clearance: Below 0 where the body may overlap something by that [m].
        radius: Likewise.
        footprint: Likewise.
    """
    check_answers("world", world, "packed", "give a World")
    whole = provable_curve(curve)
    if footprint is not None and not whole.has_its_tangents:
        name = with_article(type(curve).__name__)
        raise GeometryError(
            f"{name} is proven by cubics beside it, whose tangents differ from "
            "its own; give a piecewise cubic for a footprint, or a radius that holds the body"
        )
    given, curve = curve, whole.cubics
    if curve.dimension not in (2, 3):
        raise GeometryError(
            f"a curve of dimension {curve.dimension} can't be certified; 2 or 3 can"
        )
    if curve.dimension < dimension(world.packed):
        raise GeometryError(
            f"a curve of dimension {curve.dimension} can't be certified in a world of dimension "
            f"{dimension(world.packed)}; give it heights"
        )
    found = _proven(_bounder(curve, world, footprint), clearance + radius + whole.off)
    contact = None if found.nearest == -1 else found.contact
    u = float(found.span + found.w)
    at = np.asarray(curve.evaluate(u))
    return Certificate(
        clearance=float(found.lower) - radius - whole.off,
        required=clearance,
        tightest_at=tuple(at.tolist()),
        tightest_u=u if given is curve else whole.parameter(u),
        tightest_distance=float(curve.distance(u)),
        obstacle=None if found.nearest == -1 else world.name(int(found.nearest)),
        contact=None if contact is None else (float(contact[0]), float(contact[1])),
        tightest_heading=None if contact is None else float(contact[2]),
    )


def _bounder(
    curve: PiecewiseCubic, world: Surroundings, footprint: ArrayLike | None
) -> Callable[[float], _Bounds]:
    """From a tolerance to bounds of the distance between the body and the world."""
    spans = np.array(curve.spans)  # numba compiles read-only arrays once more
    if footprint is None:
        return lambda tolerance: _Bounds(*tightest(world.packed, spans, STILL, tolerance))
    if dimension(world.packed) != 2:
        raise GeometryError("a footprint moves in the plane, not in space: give a radius instead")
    from viaspline.kernels.clearance.footprint_walk import body_tightest, end_direction

    body = outline(footprint)
    arrival = end_direction(spans, True) if curve.closed else math.nan

    def bounds(tolerance: float) -> _Bounds:
        return _Bounds(*body_tightest(world.packed, spans, body, arrival, tolerance))

    return bounds


def _proven(bounds: Callable[[float], _Bounds], required: float) -> _Bounds:
    """Bounds as tight as they can be had, and as they have to be to tell what is required."""
    tolerance = PROOF_TOLERANCE_M
    found = bounds(tolerance)
    while math.isinf(found.lower) and math.isfinite(found.upper):
        tolerance *= 10.0
        found = bounds(tolerance)
    for tolerance in (0.01 * PROOF_TOLERANCE_M, 0.1 * PROOF_SLACK_M):
        if found.lower >= required - PROOF_SLACK_M or found.upper < required - PROOF_SLACK_M:
            break
        finer = bounds(tolerance)
        found = finer._replace(lower=max(found.lower, finer.lower))
    return found
